// The truth itself against closed forms: if these fail, no other picture test means anything.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>

#include "render/model/footprint.h"
#include "render/reference/cpu_splatter.h"
#include "render/splat/depth_order.h"
#include "tests/support/scenes.h"
#include "tests/support/splat_world.h"

namespace render {
namespace {

using tests::axis;
using timeseries::Grid;
using timeseries::RangeSet;
using namespace render::splat_world;

TEST(Truth, ASingleSplatsCentreIsTheKernelsPeak) {
    // V = l = 1, a = R: W = 5 / (pi R^2). An odd picture has a pixel on the axis.
    const auto w = weights(World(onePoint()), tests::lookFrom({0, -50, 0}, {201, 201}, 0.05));
    EXPECT_NEAR(w[100 * 201 + 100], 5 / (std::numbers::pi * kQuarticRadius * kQuarticRadius),
                1e-12);
}

TEST(Truth, ASingleSplatsTotalIsItsCellsVolume) {
    const View view = tests::lookFrom({0, -50, 0}, {201, 201}, 0.05);
    for (const Footprint footprint :
         {Footprint{Kernel::Quartic, 1}, Footprint{Kernel::Quartic, 1.5},
          Footprint{Kernel::Point, 1}, Footprint{Kernel::Point, 7}}) {
        const World world(onePoint(), RangeSet::everything(), footprint);
        // Rays diverge by up to a / z over the splat: 1.5 R / 50 squared is 2e-3.
        EXPECT_NEAR(massDrawn(weights(world, view), view, 50), 1, 2e-3)
            << "kernel " << int(footprint.kernel) << " size " << footprint.size;
    }
}

// The formula of footprint.h, with b as the distance of a ray from a centre in kernel space.
TEST(Truth, NearSplatsAreTheKernelsLineIntegralsOnEveryRay) {
    const World world(
        tests::stepOf(std::make_shared<Grid>(std::array{axis(2), axis(2, 0, 1.5), axis(2, 0, 0.8)}),
                      [](std::size_t i) { return double(i); }));
    ASSERT_FALSE(world.placed.longCells());
    const View view = tests::lookFrom({0.7, -2.2, 0.4}, {60, 50}, 0.9);
    const PixelRays rays = pixelRays(view);
    const auto w = weights(world, view);
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 60; ++x) {
            const glm::dvec2 o = glm::dvec2(x + 0.5, y + 0.5) - rays.centre;
            const glm::dvec3 d = rays.along(o);
            double expected = 0;
            for (std::size_t i = 0; i < world.step.size(); ++i) {
                const glm::dvec3 cell = world.placed.cell(i), a = kQuarticRadius * cell;
                const glm::dvec3 from = (world.placed.position(i) - rays.eye) / a, along = d / a;
                const double passed = glm::dot(from, along) / glm::length(along);
                const double b2 = glm::dot(from, from) - passed * passed;
                if (b2 < 1)
                    expected += cell.x * cell.y * cell.z /
                                (world.placed.unitLength() * a.x * a.y * a.z) * 5 /
                                std::numbers::pi * std::pow(1 - b2, 4) * glm::length(d) /
                                glm::length(along);
            }
            ASSERT_NEAR(w[std::size_t(y) * 60 + x], expected, 1e-9) << x << ' ' << y;
        }
}

TEST(Truth, ASplatOfTwiceTheSizeIsAQuarterAsDense) {
    const auto peak = [](double size) {
        const World world(onePoint(), RangeSet::everything(), {Kernel::Quartic, size});
        return weights(world, tests::lookFrom({0, -5, 0}, {101, 101}))[50 * 101 + 50];
    };
    EXPECT_NEAR(peak(2), peak(1) / 4, 1e-12);
    EXPECT_NEAR(peak(3), peak(1) / 9, 1e-12);
}

TEST(Truth, ASubsetHasTheMassOfTheWhole) {
    // Far away every point weighs the same.
    const View view = tests::lookFrom({0, -400, 0}, {65, 65}, 0.005);
    World world(tests::noise(tests::cube(12)), RangeSet::parse("0.1:0.2,0.5:0.83"));
    const double whole = massDrawn(weights(world, view), view, 400);
    for (const std::uint32_t stride : {1u, 2u, 8u, 128u, kMaxStride}) {
        world.scene.stride = stride;
        EXPECT_NEAR(massDrawn(weights(world, view), view, 400), whole, 1e-2 * whole) << stride;
    }
    // Ordered, the list holds the subset.
    world.scene.order = Order::BackToFront;
    world.scene.stride = 8;
    auto listed = std::get<Sorted>(order(world.scene, {0, -3, 0})).point;
    std::ranges::sort(listed);
    std::vector<std::uint32_t> expected;
    for (const auto& run : world.scene.layers[0].runs)
        for (std::uint64_t p = run.first; p < run.first + run.count; ++p)
            if (inSubset(p, 8)) expected.push_back(static_cast<std::uint32_t>(p));
    EXPECT_EQ(listed, expected);
    EXPECT_EQ(expected.size(), splatCount(world.scene.layers[0], 8));
}

TEST(Truth, ALayerOfFewPointsKeepsItsMassAtEveryStride) {
    for (std::uint64_t first = 0; first < 600; ++first)
        for (const std::uint64_t count : {1u, 3u, 70u})
            for (const std::uint32_t stride : {2u, 64u, kMaxStride}) {
                const Layer layer{{{first, count}}, {}};
                const auto splats = static_cast<double>(splatCount(layer, stride));
                ASSERT_GE(splats, 1);
                ASSERT_LE(splats, count);
                ASSERT_DOUBLE_EQ(splats * pointsPerSplat(layer, stride),
                                 static_cast<double>(count));
            }
    EXPECT_EQ(splatCount({}, kMaxStride), 0u);
}

TEST(Truth, TheTotalStaysWhenTheSplatIsSmallerThanAPixel) {
    // From far away the cell is a tenth of a pixel; its position between the pixels must not show.
    for (const double shift : {0.0, 0.2, 0.37, 0.5}) {
        View view = tests::lookFrom({0, -1000, 0}, {65, 65}, 0.325);
        view.viewFromWorld[3].x += shift * 2 * 0.325 / 65 * 1000;
        EXPECT_NEAR(massDrawn(weights(World(onePoint()), view), view, 1000), 1, 5e-3) << shift;
    }
}

TEST(Truth, ItStaysWherePixelsAreNotSquareEither) {
    // Of a tenth of the pixel's longer side; a radius of the shorter one alone would show.
    for (const glm::dvec2 half : {glm::dvec2(0.325, 0.1), glm::dvec2(0.1, 0.325)})
        for (const double shift : {0.0, 0.2, 0.37, 0.5}) {
            View view = tests::lookFrom({0, -1000, 0}, {65, 65});
            view.clipFromView = clipFromView({-half.x, half.x, -half.y, half.y, 0.01, 5000});
            view.viewFromWorld[3] += glm::dvec4(shift * 2.0 * half / 65.0 * 1000.0, 0, 0);
            EXPECT_NEAR(massDrawn(weights(World(onePoint()), view), view, 1000), 1, 5e-3)
                << half.x << ' ' << shift;
        }
}

TEST(Truth, UnequalSpacingsKeepTheTotalFromEverySide) {
    const auto grid = std::make_shared<Grid>(std::array{axis(2), axis(2, 0, 4), axis(2, 0, 0.25)});
    const World world(tests::stepOf(grid, [](std::size_t) { return 1.0; }));
    const glm::dvec3 cell = world.placed.cell(0);
    const double volume = 8 * cell.x * cell.y * cell.z / world.placed.unitLength();
    for (const glm::dvec3 from :
         {glm::dvec3(7, -60, 4), glm::dvec3(0, -1, 60), glm::dvec3(40, -40, 20)}) {
        const View view = tests::lookFrom(from, {301, 301}, 0.08);
        EXPECT_NEAR(massDrawn(weights(world, view), view, glm::length(from)), volume,
                    kAtCorners * volume)
            << from.x << ' ' << from.y << ' ' << from.z;
    }
}

TEST(Truth, ASlabOfUniformOpticalDepthIsItsThickness) {
    // 40 x 40 columns of 8 cells, seen from far: W is 8 along the axis, 8 / cos obliquely, to the
    // kernel's ripple of half a per cent.
    const auto grid = std::make_shared<Grid>(std::array{axis(40), axis(40), axis(8)});
    const World world(tests::stepOf(grid, [](std::size_t) { return 1.0; }));
    for (const double tilt : {0.0, 0.3, 0.6}) {
        const glm::dvec3 from = 200.0 * glm::dvec3(0, -std::sin(tilt) - 1e-9, std::cos(tilt));
        const View view = tests::lookFrom(from, {64, 64}, 0.2 / 200);
        for (const double w : weights(world, view))
            EXPECT_NEAR(w, 8 / std::cos(tilt), 0.005 * 8 / std::cos(tilt)) << "tilt " << tilt;
    }
}

TEST(Truth, AShearedSlabIsAsDeepAsTheRaysPathThroughIt) {
    // The same columns leaning: k is 30 degrees off the slab's normal, j 20 degrees off its own.
    const glm::dmat3 lean =
        tests::leaning({1, 0, 0}, {std::tan(0.35), 1, 0}, {0.5, 0, std::sqrt(0.75)});
    const auto grid = std::make_shared<Grid>(std::array{axis(40), axis(40), axis(8)},
                                             timeseries::CoordinateFrame{lean});
    const World world(tests::stepOf(grid, [](std::size_t) { return 1.0; }));
    const double cell = world.placed.cell(0).x;
    const double thickness = 8 * cell * std::sqrt(0.75) / world.placed.unitLength();
    for (const double tilt : {0.0, 0.3, 0.6}) {
        for (const double turn : {0.0, 2.0, 4.0}) {
            const glm::dvec3 from =
                200.0 * glm::dvec3(std::cos(turn) * std::sin(tilt),
                                   std::sin(turn) * std::sin(tilt) - 1e-9, std::cos(tilt));
            const View view = tests::lookFrom(from, {48, 48}, 0.15 / 200);
            const double path = thickness / std::cos(tilt);
            for (const double w : weights(world, view))
                EXPECT_NEAR(w, path, 0.005 * path) << "tilt " << tilt << " turn " << turn;
        }
    }
}

TEST(Truth, ShearedCellsKeepTheTotalFromEverySide) {
    const auto grid = std::make_shared<Grid>(
        std::array{axis(2), axis(2, 0, 2), axis(2, 0, 0.5)},
        timeseries::CoordinateFrame{tests::leaning({1, 0, 0.2}, {1.5, 1, 0}, {-0.6, 0.3, 1})});
    for (const Footprint footprint : {Footprint{Kernel::Quartic, 1}, Footprint{Kernel::Point, 3}}) {
        const World world(tests::stepOf(grid, [](std::size_t) { return 1.0; }),
                          RangeSet::everything(), footprint);
        // Each cell is l^3 large, 8 of them, counted in units of l.
        const double volume = 8 * std::pow(world.placed.unitLength(), 2);
        // Near, and so far that a pixel is larger than a cell.
        for (const double distance : {60.0, 2000.0})
            for (const glm::dvec3& from :
                 {glm::dvec3(0, -1, 0), glm::dvec3(0, -0.1, 1), glm::dvec3(1, -1, 0.5)}) {
                const View view = tests::lookFrom(distance * glm::normalize(from), {201, 201},
                                                  distance == 60 ? 0.08 : 0.2);
                EXPECT_NEAR(massDrawn(weights(world, view), view, distance), volume,
                            kAtCorners * volume)
                    << from.x << ' ' << from.z << " from " << distance;
            }
    }
}

TEST(Truth, APointSplatIsASquareOfPixelsWithTheMassOfItsCell) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (int trial = 0; trial < 60; ++trial) {
        View view = tests::lookFrom({0, -5, 0}, {33, 40});
        // On the axis, anywhere in the picture, and partly beside it.
        view.viewFromWorld[3] +=
            (trial % 3) * 3.0 * glm::dvec4(uniform(random), uniform(random), uniform(random), 0);
        const glm::dvec4 centre = view.viewFromWorld * glm::dvec4(0, 0, 0, 1);
        const double size = std::array{0.2, 1.0, 2.0, 3.4, 5.0}[std::size_t(trial) % 5];
        const double side = std::max(1.0, std::round(size));
        const glm::dmat3 directions = tests::leaning({1, 0.4, 0}, {0, 1, 0.5}, {0.3, 0, 1});
        const World world(
            tests::stepOf(std::make_shared<Grid>(std::array{axis(1), axis(1), axis(1)},
                                                 timeseries::CoordinateFrame{directions}),
                          [](std::size_t) { return 1.0; }),
            RangeSet::everything(), {Kernel::Point, size});
        const double volume = glm::determinant(directions) * std::pow(world.placed.cell(0).x, 3);
        const auto w = weights(world, view);
        const PixelRays rays = pixelRays(view);
        const glm::dvec2 first =
            glm::floor(rays.centre - rays.focal * glm::dvec2(centre) / centre.z - (side - 1) / 2);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 33; ++x) {
                const bool in =
                    x >= first.x && x < first.x + side && y >= first.y && y < first.y + side;
                const glm::dvec2 slope = (glm::dvec2(x + 0.5, y + 0.5) - rays.centre) / rays.focal;
                const double onPixel = volume / std::cbrt(volume) * rays.focal.x * rays.focal.y /
                                       (centre.z * centre.z) *
                                       std::sqrt(1 + glm::dot(slope, slope));
                ASSERT_NEAR(w[std::size_t(y) * 33 + x], in ? onPixel / (side * side) : 0,
                            1e-10 * onPixel)
                    << "trial " << trial << ", pixel " << x << ' ' << y;
            }
    }
}

}  // namespace
}  // namespace render
