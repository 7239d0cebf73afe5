// Blocks of points on the GPU: what is drawn of them, and what is uploaded.
#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <random>

#include "render/cpu_splatter.h"
#include "render/image_compare.h"
#include "tests/support/gl_planes.h"

namespace render {
namespace {

using RunOfPoints = timeseries::Run;  // testing::Test has a Run of its own

constexpr std::uint64_t kBlock = GpuStep::kBlock;

class GpuSteps : public tests::GlTest {
 protected:
    Scene sceneOf(std::vector<std::vector<RunOfPoints>> layers) const {
        Scene scene{.step = step_,
                    .lattice = lattice_,
                    .layers = {},
                    .footprint = {.kernel = Kernel::Point},
                    .order = Order::None,
                    .clip = {}};
        for (auto& runs : layers)
            scene.layers.push_back({std::move(runs), {Constant{glm::dvec3(1)}, 0.5}});
        return scene;
    }

    // Of single pixels, none outside the picture: as many as points that were drawn.
    double drawn(const Scene& scene) {
        const auto counts = plane(scene, tests::lookFrom({1, -4, 1}, {128, 128}), Channels::Count);
        return std::accumulate(counts.begin(), counts.end(), 0.0);
    }

    const timeseries::SortedStep step_ = tests::noise(tests::cube(47));  // 3.2 blocks
    const Lattice lattice_{step_.grid()};
};

TEST_F(GpuSteps, RunsAreDrawnToTheirEndsAndNoFarther) {
    const std::uint64_t n = step_.size();
    std::vector<RunOfPoints> runs = {
        {0, 1},           {n - 1, 1},           {0, n},
        {kBlock - 1, 1},  {kBlock, 1},          {kBlock - 1, 2},
        {kBlock, kBlock}, {kBlock - 1, kBlock}, {3 * kBlock, n - 3 * kBlock}};
    std::mt19937_64 random(3);
    for (int i = 0; i < 20; ++i) {
        const std::uint64_t first = random() % n;
        runs.push_back({first, 1 + random() % (n - first)});
    }
    for (const RunOfPoints& run : runs)
        EXPECT_EQ(drawn(sceneOf({{run}})), static_cast<double>(run.count))
            << run.first << " + " << run.count;
}

TEST_F(GpuSteps, RunsThatShareABlockAreDrawnOnceEach) {
    EXPECT_EQ(drawn(sceneOf({{{5, 10}, {20, 30}, {kBlock - 3, 7}}})), 47);
    EXPECT_EQ(drawn(sceneOf({{{5, 10}}, {{8, 100}, {2 * kBlock - 1, 2}}})), 112);
    EXPECT_EQ(drawn(sceneOf({{}})), 0);
}

TEST_F(GpuSteps, SpritesAndQuadsDrawTheRunsOwnPoints) {
    // Which points, not only how many: the truth reads the sorted step.
    Scene scene = sceneOf({{{kBlock - 4000, 9000}, {3 * kBlock - 10, 500}}});
    scene.footprint = {.size = 0.5};
    for (const glm::dvec3 eye : {glm::dvec3(0, -3, 0), glm::dvec3(0.2, 0.1, 0.3)}) {
        const View view = tests::lookFrom(eye, {200, 200});
        Accumulator<double> sums(view.size, {Channels::Weight});
        splat(scene, Runs{}, view, {}, sums);
        EXPECT_LE(compareScalars(plane(scene, view, Channels::Weight), sums.planes[0]).relativeL2,
                  1e-5);
    }
}

TEST_F(GpuSteps, OnlyBlocksThatWereAskedForAreUploaded) {
    GpuStep onGpu(step_, lattice_);
    EXPECT_EQ(onGpu.blocksUploaded(), 0u);
    GlSplatter splatter;
    splatter.upload(sceneOf({{{kBlock + 5, 10}}}), Runs{}, onGpu);
    EXPECT_EQ(onGpu.blocksUploaded(), 1u);
    splatter.upload(sceneOf({{{kBlock + 9, 10}}, {{2 * kBlock - 1, 2}}}), Runs{}, onGpu);
    EXPECT_EQ(onGpu.blocksUploaded(), 2u);
    splatter.upload(sceneOf({{{0, step_.size()}}}), Runs{}, onGpu);
    EXPECT_EQ(onGpu.blocksUploaded(), 4u);
}

TEST_F(GpuSteps, BlocksThatWereUploadedTakeANewColourScale) {
    const View view = tests::lookFrom({0, -3, 0}, {100, 100});
    Targets targets(view.size);
    gl::begin({.framebuffer = targets.lightFramebuffer(), .size = view.size, .clearDepth = 1.0f});
    GlSplatter splatter;
    GpuStep kept(step_, lattice_);
    const auto colored = [&](GpuStep& onGpu, double lo, double hi) {
        Scene scene = sceneOf({{{kBlock - 500, 1000}}});
        scene.layers[0].style.color = ByValue{{}, lo, hi};
        const auto list = splatter.upload(scene, Runs{}, onGpu);
        splatter.draw(*list, view, Channels::WeightedColor, 0,
                      targets.clearedPlane(0, Channels::WeightedColor));
        std::vector<float> read(4 * std::size_t(view.size.x) * view.size.y);
        glGetTextureSubImage(targets.plane(0).id(), 0, 0, 0, 0, view.size.x, view.size.y, 1,
                             GL_RGBA, GL_FLOAT, static_cast<GLsizei>(read.size() * sizeof(float)),
                             read.data());
        gl::throwOnError();
        return read;
    };
    splatter.upload(sceneOf({{{0, step_.size()}}}), Runs{}, kept);  // without values
    std::vector<std::vector<float>> pictures;
    for (const std::array<double, 2> map : {std::array{0.2, 0.4}, std::array{0.3, 0.32}}) {
        pictures.push_back(colored(kept, map[0], map[1]));
        GpuStep fresh(step_, lattice_);
        EXPECT_EQ(pictures.back(), colored(fresh, map[0], map[1]));
    }
    EXPECT_NE(pictures[0], pictures[1]) << "or nothing was told apart";
}

}  // namespace
}  // namespace render
