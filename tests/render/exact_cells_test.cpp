// Interval volumes by rays as a splatter's planes: against closed forms, and beside the cells that
// draw the same.
#include "render/reference/exact_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/splat/memory_targets.h"
#include "tests/support/cell_rays.h"
#include "tests/support/meshes.h"

namespace render {
namespace exact_cells {
namespace {

using namespace tests::cells;
using tests::CellWorld;

constexpr glm::ivec2 kSize(40, 30);

// The whole picture's plane, row 0 at the bottom.
std::vector<float> exact(const Scene& scene, const View& view, Channels channels,
                         std::size_t layer = 0, const std::vector<float>& opaque = {}) {
    MemoryTargets targets(view.size);
    targets.depth() = opaque;
    const auto sum = exactCellPlane(scene, view, channels, layer, targets);
    while (!sum->done()) sum->add(1);
    const MemoryTargets::Plane& plane = targets.plane(layer);
    EXPECT_EQ(plane.channels, channels);
    EXPECT_EQ(plane.part.size, view.size);
    return {plane.pixels.begin(), plane.pixels.end()};
}

// A field that is its own x, from 0 to 8, on a cube.
CellWorld ramp(const std::vector<std::string>& layers) {
    const auto grid = tests::cube(9);
    return {tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }), layers};
}

// The share of the box's sides, from x = lo to hi, that stands before a wall across the view.
TEST(ExactCells, RaysEndAtWhatIsOpaque) {
    CellWorld world = ramp({"2:6"});
    const View view = tests::lookFrom({3, 0, 0}, kSize, 0.05);
    const double nearest = 1.5,
                 width = world.placed.positions()[0][1] - world.placed.positions()[0][0];
    // Planes x = 6 and x = 2 in the world, by their view depth.
    const auto depthOf = [&](double x) { return 3 - world.placed.positions()[0][0] - x * width; };
    ASSERT_LT(nearest, depthOf(6));
    for (const double x : {7.0, 5.0, 3.0, 1.0}) {
        const std::vector<float> wall(std::size_t(kSize.x * kSize.y),
                                      static_cast<float>(windowDepth(view, depthOf(x))));
        const auto w = exact(world.scene, view, Channels::Weight, 0, wall);
        const std::size_t middle = w.size() / 2 + std::size_t(kSize.x) / 2;
        const double passed = std::clamp(6 - x, 0.0, 4.0) * width / world.placed.unitLength();
        EXPECT_NEAR(w[middle], passed, 2e-3 * passed + 1e-9) << x;
    }
}

// Of an optical depth and a mean colour: W c is what the map adds up to along the way, and in order
// a colour nearer to the front's.
TEST(ExactCells, ColorsAreThoseOfTheValuesOnTheWay) {
    CellWorld world = ramp({"2:6"});
    world.scene.layers[0].style.color = ByValue{ColorMap(), 2, 6};
    const View view = tests::lookFrom({3, 0, 0}, kSize, 0.05);
    const auto sums = exact(world.scene, view, Channels::WeightedColor);
    world.scene.order = Order::BackToFront;
    world.scene.layers[0].style.opacity = 0.9;
    const auto light = exact(world.scene, view, Channels::Over);
    const std::size_t middle = 4 * (sums.size() / 8 + std::size_t(kSize.x) / 2);
    constexpr int kSamples = 4000;
    glm::dvec3 mean(0), front(0);
    const double depth = opticalDepthPerWeight(0.9) * double(sums[middle + 3]);
    for (int i = 0; i < kSamples; ++i) {
        const double share = (i + 0.5) / kSamples;  // from the eye on: x falls
        const glm::dvec3 color = colorOf(world.scene.layers[0].style, 6 - 4 * share);
        mean += color / double(kSamples);
        front += color * depth * std::exp(-depth * share) / double(kSamples);
    }
    for (std::size_t c = 0; c < 3; ++c) {
        const int at = static_cast<int>(c);
        EXPECT_NEAR(sums[middle + c], double(sums[middle + 3]) * mean[at], 2e-3) << c;
        EXPECT_NEAR(light[middle + c], front[at], 5e-3) << c;
    }
    EXPECT_NEAR(light[middle + 3], -std::expm1(-depth), 1e-5);
}

// The cells of the middle ray, of each layer.
TEST(ExactCells, CountsAreOfCellsOnTheMiddleRay) {
    const CellWorld world = ramp({"2:6", "4.5:5.5"});
    const View view = tests::lookFrom({3, 0.01, 0.02}, kSize, 0.05);
    const auto count = exact(world.scene, view, Channels::Count);
    // Between points: 4 of the one, and 2 of the other.
    EXPECT_EQ(count[count.size() / 2 + std::size_t(kSize.x) / 2], 6);
    const auto far =
        exact(world.scene, tests::lookFrom({3, 0.01, 0.02}, kSize, 20), Channels::Count);
    EXPECT_EQ(far[0], 0) << "beside the volume";
}

// Thinner than is told apart in a cell: the mean of the map, on any grid.
TEST(ExactCells, AThinRangeHasTheMeanOfItsColors) {
    const auto bent = tests::curvilinear({9, 9, 9}, [](double i, double j, double k) {
        return glm::dvec3(i, j + 0.1 * std::sin(i), k + 0.05 * i);
    });
    for (const auto& grid : {tests::cube(9), bent}) {
        CellWorld world(tests::stepOfPlaces(grid, [](const glm::dvec3& p) { return p.x; }),
                        {"4.3:4.3001"});
        RangeStyle& style = world.scene.layers[0].style;
        style.color = ByValue{ColorMap(), 4.3, 4.3001};
        world.scene.opacityPer = OpacityPer::Crossing;
        constexpr int kSamples = 1000;
        glm::dvec3 mean(0);
        for (int i = 0; i < kSamples; ++i)
            mean += colorOf(style, 4.3 + 1e-4 * (i + 0.5) / kSamples) / double(kSamples);
        const auto sums = exact(world.scene, tests::lookFrom({3, -0.6, 0.4}, kSize, 0.2),
                                Channels::WeightedColor);
        int seen = 0;
        for (std::size_t i = 0; i < sums.size(); i += 4) {
            if (sums[i + 3] < 0.5f) continue;
            ++seen;
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(sums[i + std::size_t(c)] / sums[i + 3], mean[c], 0.03) << i / 4;
        }
        EXPECT_GT(seen, 100);
    }
}

double relativeL2(const std::vector<float>& is, const std::vector<float>& wanted) {
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        difference += std::pow(double(is[i]) - double(wanted[i]), 2);
        size += std::pow(double(wanted[i]), 2);
    }
    EXPECT_GT(size, 0);
    return std::sqrt(difference / size);
}

// On any grid cells draw the same, but for what they are approximations in.
TEST(ExactCells, CellsDrawNearlyTheSame) {
    const auto shell = [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(4)); };
    const auto upright = tests::cube(9);
    const auto bent = tests::curvilinear({9, 9, 9}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.1 * std::sin(j), j, k + 0.05 * i);
    });
    for (const auto& grid : {upright, bent}) {
        CellWorld world(tests::stepOfPlaces(grid, shell), {"1:2", "2.6:3.1"});
        const View view = tests::lookFrom({0.7, -3, 1.1}, {90, 70});
        Scene& scene = world.scene;
        scene.layers[0].style.color = ByValue{ColorMap(), 1, 2};
        std::vector<float> wall(std::size_t(view.size.x * view.size.y), 1.0f);
        for (std::size_t i = 0; i < wall.size() / 2; ++i)
            wall[i] = static_cast<float>(windowDepth(view, 3.2));
        for (const Light light : {Light::Off, Light::Full}) {
            scene.light = light;
            scene.order = Order::BackToFront;
            EXPECT_LT(relativeL2(tests::drawn(scene, view, Channels::Over, 0, 2, kAll, wall),
                                 exact(scene, view, Channels::Over, 0, wall)),
                      0.05);
        }
        scene.light = Light::Off;
        scene.order = Order::None;
        for (const Channels channels : {Channels::Weight, Channels::WeightedColor})
            for (const std::size_t layer : {0u, 1u})
                EXPECT_LT(relativeL2(tests::drawn(scene, view, channels, layer, 2, kAll, wall),
                                     exact(scene, view, channels, layer, wall)),
                          0.03)
                    << layer;
    }
}

}  // namespace
}  // namespace exact_cells
}  // namespace render
