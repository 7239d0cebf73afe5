// The GL splatter against the truth: the same model in double.
#include <gtest/gtest.h>

#include "render/cpu_splatter.h"
#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/gl_list.h"
#include "render/gl_splatter.h"
#include "render/image_compare.h"
#include "render/targets.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using tests::cube;
using tests::lookFrom;

class GlSplat : public testing::Test {
 protected:
    // One plane drawn on GL, rows from the bottom.
    std::vector<float> drawn(const Scene& scene, const View& view, Channels channels,
                             std::size_t layer = 0) {
        Targets targets(view.size);
        gl::begin({.framebuffer = targets.opaqueFramebuffer(),
                   .size = view.size,
                   .clearColor = glm::vec4(0),
                   .clearDepth = 1.0f});
        GpuStep step(scene.step, scene.lattice);
        GlSplatter splatter;
        const auto list = splatter.upload(scene, order(scene, {0, -3, 0}), step);
        splatter.draw(*list, view, channels, layer, targets.clearedPlane(0, channels));
        std::vector<float> plane;
        const bool scalar = channels == Channels::Weight || channels == Channels::Count;
        plane.resize(std::size_t(view.size.x) * view.size.y * (scalar ? 1 : 4));
        glGetTextureSubImage(targets.plane(0).id(), 0, 0, 0, 0, view.size.x, view.size.y, 1,
                             scalar ? GL_RED : GL_RGBA, GL_FLOAT,
                             static_cast<GLsizei>(plane.size() * 4), plane.data());
        gl::throwOnError();
        return plane;
    }
    std::vector<double> truth(const Scene& scene, const View& view, Channels channels) {
        Accumulator<double> sums(view.size, {channels});
        splat(scene, orderExactly(scene, {0, -3, 0}), view, {}, sums);
        return sums.planes[0];
    }

    gl::HeadlessContext context_;
};

TEST_F(GlSplat, OpticalDepthIsTheTruthsToOnePartIn100000) {
    const auto step = tests::noise(cube(40));
    const Lattice lattice(step.grid());
    const Scene scene{.step = step,
                      .lattice = lattice,
                      .layers = {{step.select(timeseries::RangeSet::parse("0.3:0.6")), {}}},
                      .footprint = {},
                      .order = Order::None,
                      .clip = {}};
    for (const glm::dvec3 eye :
         {glm::dvec3(0, -3, 0), glm::dvec3(2, -2, 1), glm::dvec3(0.2, 0.1, 1.4)}) {
        const View view = lookFrom(eye, {512, 512});
        const auto error = compareScalars(drawn(scene, view, Channels::Weight),
                                          truth(scene, view, Channels::Weight));
        EXPECT_LE(error.relativeL2, 1e-5) << "eye " << eye.x << ' ' << eye.y << ' ' << eye.z;
    }
}

}  // namespace
}  // namespace render
