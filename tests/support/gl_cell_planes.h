// Planes of scenes that are drawn by cells, as GL sums them, beside the processor's, which
// tests/render holds to the truth.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/model/rays_across.h"
#include "render/splat/gl_cell_splatter.h"
#include "render/splat/gl_targets.h"
#include "tests/support/cell_worlds.h"

namespace tests {

class GlCellPlanes : public testing::Test {
 protected:
    static constexpr glm::ivec2 kSize{120, 90};
    static inline const render::View kOutside = lookFrom({1.2, -2.5, 1}, kSize);
    static inline const render::View kInside = lookFrom({0.12, 0.2, -0.15}, kSize, 0.9);

    static inline const std::array<render::Lamp, 2> kLamps = {
        std::nullopt, glm::normalize(glm::dvec3(-2, -1, 2.5))};

    // Of the whole picture, row 0 at the bottom; the opaque scene is a wall at this window depth.
    std::vector<float> plane(const render::Scene& scene, const render::View& view,
                             render::Channels channels, std::size_t layer = 0,
                             std::uint64_t slice = kAllCells, float opaque = 1) {
        render::GlTargets targets(view.size);
        render::gl::begin({.framebuffer = targets.lightFramebuffer(),
                           .size = view.size,
                           .clearColor = glm::vec4(0),
                           .clearDepth = opaque});
        layers_.setLayers(scene, render::ValueScale::of(scene.layers));
        render::GlCellSplatter& by = inParts_ ? parts_ : cells_;
        const auto frame =
            by.prepare(scene, render::Runs{}, render::GlStep(scene.step, scene.placed));
        const auto sum = frame->begin(view, channels, layer, targets);
        std::uint64_t added = 0;
        while (!sum->done()) added += sum->add(slice);
        EXPECT_EQ(added, frame->splats(channels, layer));
        std::vector<float> pixels(std::size_t(view.size.x) * std::size_t(view.size.y) *
                                  render::floatsPerPixel(channels));
        glGetTextureSubImage(targets.plane(layer).id(), 0, 0, 0, 0, view.size.x, view.size.y, 1,
                             render::floatsPerPixel(channels) == 1 ? GL_RED : GL_RGBA, GL_FLOAT,
                             static_cast<GLsizei>(pixels.size() * sizeof(float)), pixels.data());
        render::gl::throwOnError();
        return pixels;
    }
    // Each plane of the scene's picture.
    void expectTheProcessors(const render::Scene& scene, const render::View& view,
                             double error = 2e-5) {
        std::vector<render::Channels> planes = render::channelsFor(scene);
        for (std::size_t k = 0; k < planes.size(); ++k)
            expectSame(
                plane(scene, view, planes[k], k),
                drawn(scene, view, planes[k], k, 2, kAllCells, {}, render::raysAcross(scene, view)),
                error);
    }
    // From outside and inside, without order and in it with each light from each lamp.
    void expectTheProcessorsInEveryLight(render::Scene& scene, double unordered, double ordered) {
        using render::Light, render::Order;
        for (const Order order : {Order::None, Order::BackToFront})
            for (const Light light : {Light::Off, Light::Soft, Light::Full})
                for (const render::Lamp& lamp : kLamps)
                    for (const render::View& view : {kOutside, kInside}) {
                        if (order == Order::None && light != Light::Off) continue;
                        if (light == Light::Off && lamp) continue;
                        scene.order = order;
                        scene.light = light;
                        scene.lamp = lamp;
                        SCOPED_TRACE(testing::Message()
                                     << static_cast<int>(order) << static_cast<int>(light)
                                     << lamp.has_value() << view.viewFromWorld[3][2]);
                        expectTheProcessors(scene, view,
                                            order == Order::None ? unordered : ordered);
                    }
    }
    // Relative L2.
    static void expectSame(const std::vector<float>& is, const std::vector<float>& expected,
                           double error) {
        ASSERT_EQ(is.size(), expected.size());
        double off = 0, all = 0;
        for (std::size_t i = 0; i < is.size(); ++i) {
            ASSERT_TRUE(std::isfinite(is[i])) << i;
            off += std::pow(double{is[i]} - double{expected[i]}, 2);
            all += std::pow(double{expected[i]}, 2);
        }
        ASSERT_GT(all, 0) << "nothing was compared";
        EXPECT_LT(std::sqrt(off / all), error);
    }

    static std::shared_ptr<render::GlPieces> whole(const render::Scene& scene, std::uint64_t most,
                                                   render::GlCellLister& lister) {
        auto pieces = render::GlPieces::begin(scene, most, lister);
        while (pieces->goOn(scene, kAllCells) < 1) {
        }
        return pieces;
    }

    render::gl::HeadlessContext context_;
    render::GlSplatter layers_;
    render::GlCellSplatter cells_{layers_}, parts_{layers_, 100'000};
    render::GlCellLister lister_;
    bool inParts_ = false;
};

}  // namespace tests
