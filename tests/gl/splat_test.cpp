// The GL splatter, and the rows that stand in for it on the processor, against the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>

#include "tests/support/splats_and_truth.h"

namespace render {
namespace {

using namespace splats_and_truth;

TEST_F(GlSplat, OpticalDepthIsTheTruthsToOnePartIn100000) {
    const auto step = tests::noise(cube(32));
    const PlacedPoints placed(step.grid());
    const Scene scene = noiseScene(step, placed, "0.3:0.6");
    // From outside with point sprites; from inside and from a corner with quads.
    for (const glm::dvec3 eye : {glm::dvec3(0, -3, 0), glm::dvec3(2, -2, 1),
                                 glm::dvec3(0.2, 0.1, 0.3), glm::dvec3(0.5, 0.5, 0.52)})
        EXPECT_LE(error(*this, scene, lookFrom(eye, {320, 320}), Channels::Weight), kTarget)
            << "eye " << eye.x << ' ' << eye.y << ' ' << eye.z;
}

TEST_F(GlSplat, UnequalAndUnevenCellsAreTheTruths) {
    timeseries::Axis uneven = tests::axis(12, 0, 1);
    for (double& x : uneven.coordinates) x = std::exp(0.4 * x);
    const auto grid = std::make_shared<timeseries::Grid>(
        std::array{tests::axis(30, 5, -0.2), tests::axis(20, 0, 0.7), uneven});
    const auto step = tests::noise(grid);
    const PlacedPoints placed(*grid);
    const Scene scene = noiseScene(step, placed, "0.2:0.4");
    for (const glm::dvec3 eye : {glm::dvec3(0, -3, 0.4), glm::dvec3(0.3, -0.2, 2.5)})
        EXPECT_LE(error(*this, scene, lookFrom(eye, {400, 300}), Channels::Weight), kTarget);
}

TEST_F(GlSplat, TurnedAndShearedCellsAreTheTruths) {
    const std::array cubic{tests::axis(20), tests::axis(20), tests::axis(20)};
    const std::array unequal{tests::axis(24, 5, -0.2), tests::axis(16, 0, 0.7),
                             tests::axis(12, 0, 0.4)};
    const glm::dmat3 mirrored = tests::leaning({-1, 0.2, 0}, {0.4, 1, 0.3}, {-0.5, 0.3, 1});
    const glm::dmat3 flat = tests::leaning({1, 0, 0}, {1, 0.2, 0}, {0.3, 0.1, 1});
    for (const timeseries::Grid& grid :
         {timeseries::Grid(cubic, {tests::rotation(0.9)}), timeseries::Grid(cubic, {mirrored}),
          timeseries::Grid(unequal, {tests::rotation(2.2)}), timeseries::Grid(unequal, {flat})}) {
        const auto step = tests::noise(std::make_shared<timeseries::Grid>(grid));
        const PlacedPoints placed(grid);
        Scene scene = noiseScene(step, placed, "0.2:0.4", {ByValue{{}, 0.2, 0.4}, 0.3});
        const double volume = glm::determinant(placed.worldFromAxes());
        // Sprites, quads, and cells below a pixel.
        for (const glm::dvec3& eye :
             {glm::dvec3(0, -3, 0.4), glm::dvec3(0.3, -0.2, 0.1), glm::dvec3(200, -300, 150)}) {
            const View view = lookFrom(eye, {200, 160}, glm::length(eye) > 10 ? 0.02 : 0.4);
            EXPECT_LE(error(*this, scene, view, Channels::Weight), kTarget)
                << volume << ' ' << eye.x;
        }
        const View view = lookFrom(tests::kMidEye, {200, 200});
        scene.order = Order::BackToFront;
        Accumulator<double> inThatOrder(view.size, {Channels::Over});
        splat(scene, order(scene, tests::kMidEye), view, {}, inThatOrder);
        EXPECT_LE(
            compareScalars(plane(scene, view, Channels::Over), inThatOrder.planes[0]).relativeL2,
            kTarget)
            << volume;
        scene.order = Order::None;
        scene.footprint = {Kernel::Point, 3};
        const auto drawn = plane(scene, view, Channels::Weight);
        const auto expected = truth(scene, view, Channels::Weight);
        const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
        EXPECT_NEAR(std::accumulate(drawn.begin(), drawn.end(), 0.0), total, 1e-5 * total)
            << volume;
    }
}

TEST_F(GlSplat, AsymmetricAndWideFrustaAreTheTruths) {
    const auto step = tests::noise(cube(24));
    const PlacedPoints placed(step.grid());
    const Scene scene = noiseScene(step, placed, "0.3:0.6");
    View view = lookFrom({0, -1.3, 0}, {500, 400});
    view.clipFromView = clipFromView({-1.4, 0.3, -0.2, 1.1, 0.05, 50});
    EXPECT_LE(error(*this, scene, view, Channels::Weight), kTarget);
}

TEST_F(GlSplat, ColourByValueIsTheTruths) {
    const auto step = tests::noise(cube(24));
    const PlacedPoints placed(step.grid());
    const View view = lookFrom({1, -3, 1}, {300, 300});
    // Map ends inside, outside and equal.
    for (const auto& [lo, hi] : {std::pair(0.3, 0.6), std::pair(-1.0, 4.0), std::pair(0.5, 0.5)}) {
        const Scene scene = noiseScene(step, placed, "0.3:0.6", {ByValue{{}, lo, hi}, 0.5});
        EXPECT_LE(error(*this, scene, view, Channels::WeightedColor), kTarget) << lo << ' ' << hi;
    }
}

TEST_F(GlSplat, OrderedOverIsTheTruthsToTheOrdersResolution) {
    const auto step = tests::noise(cube(24));
    const PlacedPoints placed(step.grid());
    Scene scene = noiseScene(step, placed, "0.1:0.6", {ByValue{{}, 0.1, 0.6}, 0.3});
    scene.layers.push_back({step.select(RangeSet::parse("0.8:0.9")), {Constant{{1, 0, 0}}, 0.9}});
    scene.order = Order::BackToFront;
    for (const glm::dvec3 eye : {tests::kMidEye, glm::dvec3(0.03, -3, 0.02)}) {
        // The second eye stands beside the point that the order was made for.
        const View view = lookFrom(eye, {300, 300});
        const auto expected = truth(scene, view, Channels::Over);
        const auto errorOf = [&](const std::vector<float>& drawn) {
            return compareScalars(drawn, expected).relativeL2;
        };
        // Four in five of these points are as far from the list's eye as a mirror image of theirs.
        // Keys in double leave these in the order of value, as the truth does but for last bits.
        EXPECT_LE(errorOf(onProcessor(scene, view, Channels::Over)), 1e-4);
        // The GPU's are worked out in float, of whose 24 bits a key of 22 leaves a quarter of a
        // step: of points that are as far away some fall into two steps, and come in that order
        // (1.5e-4; of an eye without mirror images the list costs nothing).
        EXPECT_LE(errorOf(plane(scene, view, Channels::Over)), 2e-4);
    }
}

TEST_F(GlSplat, CountsEveryFootprintThatTouchesAPixel) {
    const auto step = tests::noise(cube(16));
    const PlacedPoints placed(step.grid());
    const Scene scene = noiseScene(step, placed, "0.3:0.6");
    const View view = lookFrom({1, -3, 1}, {200, 200});
    const auto drawn = plane(scene, view, Channels::Count);
    const auto expected = truth(scene, view, Channels::Count);
    // A pixel on a footprint's very border may fall to either side in float.
    std::size_t differing = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        ASSERT_LE(std::abs(static_cast<double>(drawn[i]) - expected[i]), 1) << i;
        differing += static_cast<double>(drawn[i]) != expected[i];
    }
    EXPECT_LE(differing, drawn.size() / 1000);
}

TEST_F(GlSplat, ClippedPointsAreNotDrawn) {
    const auto step = tests::noise(cube(20));
    const PlacedPoints placed(step.grid());
    Scene scene = noiseScene(step, placed, "0:1");
    scene.clip = indexBox(step.grid(), {3, 5, 2}, {9, 19, 8.5});
    EXPECT_LE(error(*this, scene, lookFrom({1, -3, 1}, {256, 256}), Channels::Weight), kTarget);
}

TEST_F(GlSplat, TheOpaqueSceneHidesWhatLiesBehindIt) {
    const auto step = tests::noise(cube(20));
    const PlacedPoints placed(step.grid());
    const Scene scene = noiseScene(step, placed, "0:1");
    const View view = lookFrom({0, -3, 0}, {128, 128});
    // A wall through the points, at a depth that no point has exactly.
    const glm::dvec4 wall = view.clipFromView * glm::dvec4(0, 0, -3.01, 1);
    const auto depth = static_cast<float>(wall.z / wall.w);
    const auto drawn = plane(scene, view, Channels::Weight, depth);
    const auto expected =
        truth(scene, view, Channels::Weight, std::vector<float>(128 * 128, depth));
    EXPECT_LE(compareScalars(drawn, expected).relativeL2, kTarget);
    EXPECT_LT(compareScalars(drawn, truth(scene, view, Channels::Weight)).relativeL2, 1);
    EXPECT_GT(compareScalars(drawn, truth(scene, view, Channels::Weight)).relativeL2, 0.1);
}

TEST_F(GlSplat, ASubsetIsTheTruthsSubset) {
    // A third run shorter than the largest stride.
    const auto step = tests::noise(cube(16));
    const PlacedPoints placed(step.grid());
    Scene scene =
        noiseScene(step, placed, "0.1:0.2,0.3:0.45,0.5:0.501", {ByValue{{}, 0.1, 0.5}, 0.3});
    for (const std::uint32_t stride : {2u, 8u, kMaxStride}) {
        scene.stride = stride;
        for (const glm::dvec3 eye : {glm::dvec3(1, -3, 1), glm::dvec3(0.2, 0.1, 0.3)}) {
            const View view = lookFrom(eye, {160, 160});
            scene.order = Order::None;
            for (const Channels channels : {Channels::Weight, Channels::WeightedColor})
                EXPECT_LE(error(*this, scene, view, channels), kTarget) << stride << ' ' << eye.x;
            scene.order = Order::BackToFront;
            // Heavier splats: two that lie within one key of the order count for more.
            EXPECT_LE(error(*this, scene, view, Channels::Over), 1e-3) << stride << ' ' << eye.x;
        }
        // A splat's border is within float rounding of some pixels' centres.
        scene.order = Order::None;
        const View view = lookFrom({1, -3, 1}, {160, 160});
        EXPECT_LE(error(*this, scene, view, Channels::Count), 5e-3) << stride;
    }
}

}  // namespace
}  // namespace render
