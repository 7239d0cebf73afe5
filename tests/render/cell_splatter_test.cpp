// Interval volumes drawn cell by cell, against path lengths in closed form and against samples of
// the interpolated field along rays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "render/reference/interval_truth.h"
#include "render/splat/cell_pieces.h"
#include "tests/support/cell_rays.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"

namespace render {
namespace {

using namespace tests::cells;
using tests::axis;
using tests::CellWorld;
using tests::drawn;
using timeseries::Grid;

TEST(CellSplatter, AFieldSelectedWholeIsAsDeepAsTheRaysWayThroughTheDomain) {
    const auto lean = tests::leaning({1, 0, 0.2}, {0.5, 1, 0}, {-0.3, 0.3, 1});
    const std::array axes{axis(4), axis(5, 0, 0.7), axis(1)};
    for (const auto& grid :
         {unevenGrid(), std::make_shared<const Grid>(axes, timeseries::CoordinateFrame{lean})}) {
        const CellWorld world(tests::noise(grid), {"min:max"});
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, {40, 30});
            const std::vector<float> w = drawn(world.scene, view);
            for (int y = 0; y < view.size.y; ++y)
                for (int x = 0; x < view.size.x; ++x) {
                    const double path = pathThrough(world, view, x, y, world.placed.domain());
                    ASSERT_NEAR(w[std::size_t(y) * 40 + std::size_t(x)], path, 2e-5 * (1 + path))
                        << x << ' ' << y << " from " << from.x;
                }
        }
    }
}

// What a frame was to cost, and how long it took, is told from that: of few as of many, however
// much is asked for at once.
TEST(CellSplatter, TellsHowManyCellsItAdds) {
    for (const Order order : {Order::None, Order::BackToFront}) {
        CellWorld world(tests::noise(tests::cube(9)), {"0.4:0.6"});
        world.scene.order = order;
        const Channels channels = order == Order::None ? Channels::Weight : Channels::Over;
        const std::uint64_t cells = cellCount(world.scene, channels, 0);
        for (const std::uint64_t slice : {std::uint64_t{7}, tests::kAllCells}) {
            CellSum sum(world.scene, tests::lookFrom({3, -0.4, 0.3}, {40, 30}), channels, 0, {}, 1,
                        2);
            std::uint64_t added = 0;
            while (!sum.done()) added += sum.add(slice);
            EXPECT_GE(added, cells);
            EXPECT_LE(added, cells + cells / 8) << "listing them counts, too";
        }
    }
}

// Along a ray a linear field takes each value once: a range is as deep as it is thick, however
// thin.
TEST(CellSplatter, AThinRangeOfALinearFieldIsAClosedShellOfItsThickness) {
    const auto grid = tests::cube(9);
    for (const double width : {2.0, 0.1, 0.001}) {
        const CellWorld world(
            tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
            {"4.3~" + std::to_string(width / 2)});
        const View view = tests::lookFrom({3, -0.4, 0.3}, {64, 64}, 0.05);
        const std::vector<float> w = drawn(world.scene, view);
        const double spacing =
            std::abs(world.placed.positions()[0][1] - world.placed.positions()[0][0]);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
                const double wanted = width * spacing / std::abs(ray.along.x) * ray.length /
                                      world.placed.unitLength();
                ASSERT_NEAR(w[std::size_t(y) * 64 + std::size_t(x)], wanted, 2e-2 * wanted)
                    << width << " at " << x << ' ' << y;
            }
    }
}

TEST(CellSplatter, IsTheIntervalVolumeOfTheInterpolatedField) {
    const auto grid = std::make_shared<Grid>(std::array{axis(12), axis(10, 7, -1.3), axis(9)});
    std::vector<float> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 p = grid->position(i);
        values[i] = static_cast<float>(std::sin(0.5 * p.x + 0.3) * std::cos(0.4 * p.y) +
                                       0.2 * p.z * std::sin(0.3 * p.y));
    }
    const CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return values[i]; }),
                          {"0.1:0.5"});
    // What linear pieces leave of a cubic, and the samples of the truth.
    for (const glm::dvec3& from : kFrom) {
        const View view = tests::lookFrom(from, {24, 20}, 0.12);
        std::vector<double> wanted;
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 24; ++x)
                wanted.push_back(sampled(world, values, view, x, y, 0.1, 0.5));
        EXPECT_LT(relativeL2(drawn(world.scene, view), wanted), 0.02) << from.x;
    }
}

// Of a field of many waves, as turbulence is. A range's width is told in steps between neighbours,
// root mean square.
TEST(CellSplatter, AThinRangesErrorIsBoundedHoweverThinItIs) {
    constexpr unsigned kSide = 20;
    const auto grid = tests::cube(kSide);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<float> values(grid->count());
    for (int wave = 0; wave < 60; ++wave) {
        const glm::dvec3 k = 0.35 * glm::dvec3(normal(random), normal(random), normal(random));
        const double phase = 10 * normal(random);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] += static_cast<float>(std::sin(glm::dot(k, grid->position(i)) + phase) /
                                            std::sqrt(60));
    }
    double squares = 0;
    for (std::size_t i = 0; i + 1 < values.size(); ++i)
        if ((i + 1) % kSide != 0) squares += std::pow(double(values[i + 1]) - double(values[i]), 2);
    const double between = std::sqrt(squares / double(values.size() - kSide * kSide));
    // With two pieces, or ramps as wide as both changes together, at least one of them is passed.
    for (const auto& [width, bound] : {std::pair(3.0, 0.0025), {0.3, 0.015}, {0.03, 0.06}}) {
        const CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return values[i]; }),
                              {"0.2~" + std::to_string(width * between / 2)});
        const IntervalTruth truth(world.scene, world.scene.cells->field(), 5);
        const View view = tests::lookFrom({0.7, -2, 1.1}, {64, 64}, 0.1);
        EXPECT_LT(relativeL2(drawn(world.scene, view), truth.weight(view, 0)), bound) << width;
    }
}

// A range that ends at a plateau's value holds all of it, and what two ranges hold is their sum.
TEST(CellSplatter, PlateausAndUnionsAreWhole) {
    const auto grid = tests::cube(6);
    const auto step = [&](std::size_t i) { return grid->indices(i).x < 3 ? 0.0 : 1.0; };
    const View view = tests::lookFrom({0.7, -3, 1.1}, {30, 24});
    const CellWorld both(tests::stepOf(grid, step),
                         {"0:1", "0:0,1:1", "0:0.25,0.75:1", "0:0.25", "0.75:1"});
    const std::vector<float> whole = drawn(both.scene, view);
    std::vector<double> parts(whole.size());
    for (const std::size_t layer : {3u, 4u}) {
        const std::vector<float> part = drawn(both.scene, view, Channels::Weight, layer);
        for (std::size_t i = 0; i < parts.size(); ++i) parts[i] += double(part[i]);
    }
    const std::vector<float> plateaus = drawn(both.scene, view, Channels::Weight, 1);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 30; ++x) {
            const std::size_t at = std::size_t(y) * 30 + std::size_t(x);
            ASSERT_NEAR(whole[at], pathThrough(both, view, x, y, both.placed.domain()), 1e-4);
            // Between the plateaus there is one cell, which holds neither value but at its ends.
            PlacedPoints::Box between = both.placed.domain();
            between.lo.x = both.placed.positions()[0][2];
            between.hi.x = both.placed.positions()[0][3];
            const double without = whole[at] - pathThrough(both, view, x, y, between);
            ASSERT_NEAR(plateaus[at], without, 0.02 * (1 + without)) << x << ' ' << y;
        }
    EXPECT_LT(relativeL2(drawn(both.scene, view, Channels::Weight, 2), parts), 1e-6);
}

// What is nearest to a missing point, or to one beside the clip box, is not there.
TEST(CellSplatter, MissingAndClippedPointsTakeTheirCellsAway) {
    const auto grid = unevenGrid();
    const glm::uvec3 gone(2, 1, 1);
    const auto isGone = [&](std::size_t i) { return glm::uvec3(grid->indices(i)) == gone; };
    const CellWorld holed(
        tests::stepOf(grid, [&](std::size_t i) { return isGone(i) ? kNan : 1.0; }), {"0:2"});
    CellWorld clipped(tests::stepOf(grid, [](std::size_t) { return 1.0; }), {"0:2"});
    clipped.scene.clip = {gone, gone};
    const View view = tests::lookFrom(kFrom[0], {40, 30});
    const std::vector<float> without = drawn(holed.scene, view), alone = drawn(clipped.scene, view);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const double all = pathThrough(holed, view, x, y, holed.placed.domain());
            const double one = pathThrough(holed, view, x, y, boxOf(holed.placed, gone));
            const std::size_t at = std::size_t(y) * 40 + std::size_t(x);
            ASSERT_NEAR(without[at], all - one, 1e-4) << x << ' ' << y;
            ASSERT_NEAR(alone[at], one, 1e-4) << x << ' ' << y;
        }
}

// Where the field does not change towards what is missing, a surface goes on straight to where it
// ends, half a cell farther.
TEST(CellSplatter, BesideMissingPointsTheFieldGoesOn) {
    const auto grid = tests::cube(9);
    CellWorld whole(tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
                    {"2.3:2.4"});
    CellWorld half(tests::stepOf(grid,
                                 [&](std::size_t i) {
                                     const auto at = grid->indices(i);
                                     return at.y < 4 ? kNan : double(at.x);
                                 }),
                   {"2.3:2.4"});
    // From the side of the surface; what is there is as it is without what is missing, but that a
    // pixel is wider beside an octant than beside its cell.
    const View view = tests::lookFrom({3, 0.2, 0.1}, {64, 64});
    const std::vector<float> all = drawn(whole.scene, view), some = drawn(half.scene, view);
    int there = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!(some[i] > 0.9f * all[i]) || all[i] == 0) continue;  // at the end, and beyond it
        ++there;
        ASSERT_NEAR(some[i], all[i], 5e-3 * all[i]) << i;
    }
    double sumAll = 0, sumSome = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        sumAll += all[i];
        sumSome += some[i];
    }
    EXPECT_GT(there, 500);
    // Cells 0 to 8 along y reach half a step beyond both ends: of 9 steps 5 are left.
    EXPECT_NEAR(sumSome / sumAll, 5.0 / 9, 0.03);
}

// Whole numbers are rounded ones: 3 stands for 2.5 to 3.5.
TEST(CellSplatter, RangesOfWholeNumbersReachHalfANumberFarther) {
    const auto grid = tests::cube(8);
    std::vector<std::uint8_t> values;
    for (std::size_t i = 0; i < grid->count(); ++i)
        values.push_back(static_cast<std::uint8_t>(grid->indices(i).x));
    const CellWorld world(tests::sorted({grid, std::move(values), {}}), {"3"});
    const View view = tests::lookFrom({3, 1e-3, 2e-3}, {9, 9}, 0.01);
    EXPECT_NEAR(drawn(world.scene, view)[4 * 9 + 4], 1, 1e-3);
}

TEST(CellSplatter, IsTheSameForAnyThreadsAndSlices) {
    CellWorld world(tests::noise(unevenGrid()), {"0.2:0.5", "0.4:0.45,0.6:max"});
    for (const Channels channels :
         {Channels::Weight, Channels::WeightedColor, Channels::Over, Channels::Count}) {
        world.scene.order = channels == Channels::Over ? Order::BackToFront : Order::None;
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, {40, 30});
            const auto once = drawn(world.scene, view, channels, 0, 1);
            EXPECT_GT(std::accumulate(once.begin(), once.end(), 0.0f), 1);
            EXPECT_EQ(once, drawn(world.scene, view, channels, 0, 2));
            EXPECT_EQ(once, drawn(world.scene, view, channels, 0, 5));
            EXPECT_EQ(once, drawn(world.scene, view, channels, 0, 3, 7));
        }
    }
}

}  // namespace
}  // namespace render
