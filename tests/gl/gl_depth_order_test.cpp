// The draw list that the GPU makes, against the one that the program makes and against distances in
// double.
#include "render/splat/gl_depth_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/splat/depth_order.h"
#include "render/splat/gl_list.h"
#include "render/splat/gl_targets.h"
#include "tests/support/gl_buffers.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using timeseries::RangeSet;

constexpr std::uint32_t kNoLayer = 255;  // shaders/splat_points.glsl

std::vector<SortedPoint> read(const GlDepthOrder::List& list) {
    return tests::contentsOf<SortedPoint>(*list.points, list.count);
}

// Two layers that overlap, one of them by value.
struct GpuWorld {
    explicit GpuWorld(std::shared_ptr<const timeseries::Grid> grid) : step(tests::noise(grid)) {
        scene.layers = {{step.select(RangeSet::parse("0.1:0.5")), {ByValue{{}, 0.1, 0.5}, 0.2}},
                        {step.select(RangeSet::parse("0.4:0.43,0.6:0.7")), {}}};
    }
    std::vector<SortedPoint> onGpu(const glm::dvec3& eye) {
        step_.upload(scene, neededScale(scene));
        return read(order_(scene, eye, step_));
    }
    // Sorted by grid index, then by layer.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> listed(const glm::dvec3& eye) const {
        const auto sorted = std::get<Sorted>(order(scene, eye));
        std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
        for (std::size_t i = 0; i < sorted.point.size(); ++i)
            all.emplace_back(step.gridIndex()[sorted.point[i]], sorted.layer[i]);
        std::ranges::sort(all);
        return all;
    }
    void expectTheProgramsList(const glm::dvec3& eye);

    const gl::HeadlessContext context;
    timeseries::SortedStep step;
    PlacedPoints placed{step.grid()};
    Scene scene{.step = step,
                .placed = placed,
                .layers = {},
                .footprint = {},
                .order = Order::BackToFront,
                .clip = {}};

 private:
    GlStep step_{step, placed};
    GlDepthOrder order_;
};

void GpuWorld::expectTheProgramsList(const glm::dvec3& eye) {
    std::vector<SortedPoint> points = onGpu(eye);
    const auto seen = std::ranges::find(points, kNoLayer, &SortedPoint::layer);
    EXPECT_TRUE(std::all_of(seen, points.end(), [](auto& p) { return p.layer == kNoLayer; }))
        << "clipped ones come last";
    points.erase(seen, points.end());
    const DepthKeys keys = depthKeysOf(scene, eye);
    double before = std::numeric_limits<double>::infinity();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
    std::vector<double> values(step.size());  // every point has one
    const auto columns = columnsOf(scene);
    for (const Layer& layer : scene.layers)
        for (const auto& run : layer.runs)
            for (std::uint64_t p = run.first; p < run.first + run.count; ++p)
                values[columns.gridIndex[p]] = valueOf(columns, p);
    for (const SortedPoint& point : points) {
        const double away = glm::distance(placed.position(point.gridIndex), eye);
        ASSERT_LE(away, before + 2 / keys.perUnit) << "by more than a key of 2^22 and float";
        before = std::min(before, away);
        all.emplace_back(point.gridIndex, point.layer);
        ASSERT_EQ(point.value, step_.valueScale()(values[point.gridIndex]));
    }
    std::ranges::sort(all);
    EXPECT_EQ(all, listed(eye));
    EXPECT_FALSE(all.empty());
}

const glm::dvec3 kEyesOfLists[] = {
    {0, -3, 0}, {0.1, 0.05, -0.2}, {0, 0, 0}, {100, 40, 7}, {1e6, 2e5, 3}};

std::shared_ptr<const timeseries::Grid> leaning() {
    return std::make_shared<timeseries::Grid>(
        std::array{tests::axis(20), tests::axis(15, 0, 1.7), tests::axis(31, 3, 0.6)},
        timeseries::CoordinateFrame{tests::leaning({1, 0.3, 0}, {0.5, -1, 0}, {0.4, 0.2, 1}), {}});
}

// Tiles and blocks that are not full: 9,300 points, and 274,625.
TEST(GlDepthOrder, IsTheProgramsOfAnyEye) {
    for (const auto& grid : {leaning(), tests::cube(65)}) {
        GpuWorld world(grid);
        for (const glm::dvec3& eye : kEyesOfLists) world.expectTheProgramsList(eye);
    }
}

TEST(GlDepthOrder, LeavesOutWhatTheProgramDoes) {
    GpuWorld world(leaning());
    world.scene.clip = {{3, 2, 0}, {12, 11, 20}};
    world.expectTheProgramsList(kEyesOfLists[0]);
    world.scene.stride = 8;
    world.expectTheProgramsList(kEyesOfLists[0]);
    world.scene.clip = {};
    world.expectTheProgramsList(kEyesOfLists[1]);
}

TEST(GlDepthOrder, OfAMeshIsTheProgramsToo) {
    GpuWorld world(tests::curvilinear({24, 18, 20}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.2 * k, j - 0.1 * i * i / 24, k * (1 + 0.02 * j));
    }));
    for (const glm::dvec3& eye : kEyesOfLists) world.expectTheProgramsList(eye);
    world.scene.clip = {{3, 2, 0}, {12, 11, 15}};
    world.expectTheProgramsList(kEyesOfLists[0]);
}

// However far the eye is, points that lie sixteen keys apart on its ray come one after another.
TEST(GlDepthOrder, AnEyeFarAwayCostsNoDigits) {
    constexpr std::size_t kCount = 1 << 18;
    GpuWorld world(std::make_shared<timeseries::Grid>(
        std::array{tests::axis(kCount), tests::axis(1), tests::axis(1)}));
    world.scene.layers = {{world.step.select(RangeSet::everything()), {ByValue{{}, 0, 1}, 0.2}}};
    for (const double away : {3.0, 1e3, 1e9}) {
        const auto points = world.onGpu({-away, 0, 0});
        ASSERT_EQ(points.size(), kCount);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < kCount; ++i)
            wrong += points[i].gridIndex == kCount - 1 - i ? 0 : 1;
        EXPECT_EQ(wrong, 0u) << away;
    }
}

// More runs than workgroups go side by side, of two points each.
TEST(GlDepthOrder, TakesRunsByTheTenThousand) {
    constexpr std::size_t kRuns = 70'000;
    GpuWorld world(std::make_shared<timeseries::Grid>(
        std::array{tests::axis(2), tests::axis(1), tests::axis(1)}));
    world.scene.layers.resize(1);
    world.scene.layers[0].runs.clear();
    for (std::uint64_t i = 0; i < kRuns; ++i) world.scene.layers[0].runs.push_back({i % 2, 1});
    const auto points = world.onGpu({-3, 0, 0});
    ASSERT_EQ(points.size(), kRuns);
    for (std::size_t i = 0; i < kRuns; ++i)
        ASSERT_EQ(points[i].gridIndex, i < kRuns / 2 ? 1u : 0u) << i;
}

TEST(GlDepthOrder, OfNothingIsNothing) {
    GpuWorld world(leaning());
    world.scene.layers.clear();
    EXPECT_TRUE(world.onGpu(kEyesOfLists[0]).empty());
}

// A driver that binds less takes a list that the program makes: the same picture.
TEST(GlDepthOrder, WhatIsTooLargeForItTheProgramPutsInOrder) {
    GpuWorld world(tests::cube(20));
    const View view = tests::lookFrom({1, -3, 1}, {80, 60});
    const auto picture = [&](std::uint64_t most) {
        GlStep step(world.step, world.placed);
        step.upload(world.scene, neededScale(world.scene));
        GlSplatter splatter(most);
        EXPECT_EQ(splatter.sortsOnGpu(world.scene, step), most > 1000);
        GlTargets targets(view.size);
        gl::begin({.framebuffer = targets.lightFramebuffer(),
                   .size = view.size,
                   .clearColor = glm::vec4(0),
                   .clearDepth = 1.0f});
        const auto list =
            splatter.upload(world.scene, splatter.order(world.scene, pixelRays(view).eye), step);
        splatter.draw(*list, view, Channels::Over, 0, targets.clearedPlane(0, Channels::Over));
        std::vector<float> read(std::size_t(4) * 80 * 60);
        glGetTextureImage(targets.plane(0).id(), 0, GL_RGBA, GL_FLOAT,
                          static_cast<GLsizei>(read.size() * sizeof(float)), read.data());
        gl::throwOnError();
        return read;
    };
    const auto onGpu = picture(GlDepthOrder::mostBytes()), here = picture(1000);
    float most = 0;
    for (std::size_t i = 0; i < onGpu.size(); ++i) {
        ASSERT_NEAR(onGpu[i], here[i], 1e-3) << i;
        most = std::max(most, onGpu[i]);
    }
    EXPECT_GT(most, 0.5f);
}

}  // namespace
}  // namespace render
