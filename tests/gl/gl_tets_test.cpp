// Interval volumes of grids whose points lie one by one by GL, tetrahedron by tetrahedron: what the
// processor draws, which tests/render holds to the truth.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "render/gl/debug_output.h"
#include "render/model/rays_across.h"
#include "render/splat/gl_tets.h"
#include "tests/support/gl_buffers.h"
#include "tests/support/gl_cell_planes.h"
#include "tests/support/meshes.h"
#include "tests/support/sorted.h"
#include "tests/support/unstructured.h"

namespace render {
namespace {

using tests::CellWorld;
using tests::drawn;
using tests::lookFrom;
using timeseries::Grid;
using GlTetsOf = tests::GlCellPlanes;

// One of each kind: six tetrahedra about a diagonal; fans of the faces of cells of every shape, and
// cones about the middles of some that have the values.
std::vector<std::shared_ptr<const Grid>> grids() {
    std::vector<std::shared_ptr<const Grid>> all{tests::twisted()};
    for (const tests::Cut cut : tests::kCuts)
        all.push_back(tests::gridOf(tests::atPoints(tests::bentBricks(cut))));
    for (const tests::Cut cut : {tests::Cut::Tetrahedra, tests::Cut::Polyhedra})
        all.push_back(tests::gridOf(tests::atCells(tests::bentBricks(cut))));
    return all;
}

TEST_F(GlTetsOf, LengthsAreTheProcessorsFromOutsideAndInside) {
    for (const auto& grid : grids())
        for (const char* range : {"0.3:0.6", "min:max", "0.5~0.01", "0.5"}) {
            CellWorld world(tests::noise(grid), {range});
            for (const OpacityPer per : {OpacityPer::Length, OpacityPer::Crossing}) {
                if (per == OpacityPer::Length && std::string_view(range) == "0.5") continue;
                world.scene.opacityPer = per;
                for (const View& view : {kOutside, kInside}) {
                    SCOPED_TRACE(testing::Message() << range << (per == OpacityPer::Crossing));
                    expectTheProcessors(world.scene, view, 3e-4);
                }
            }
        }
}

// Values that points have, so that tetrahedra touch the range; each ray passes it once.
TEST_F(GlTetsOf, RangesAtTheValuesOfPointsAreTheProcessors) {
    const auto grid = tests::twisted();
    const auto layers = [&](std::size_t i) { return double(grid->indices(i).x); };
    for (const char* range : {"2", "2:2.05", "1.95:2"}) {
        CellWorld world(tests::stepOf(grid, layers), {range});
        world.scene.opacityPer = OpacityPer::Crossing;
        SCOPED_TRACE(range);
        EXPECT_GT(std::ranges::max(tests::drawn(world.scene, kOutside)), 0.9);
        for (const View& view : {kOutside, kInside}) expectTheProcessors(world.scene, view, 3e-4);
    }
}

TEST_F(GlTetsOf, ColoursLightAndOrderAreTheProcessors) {
    for (const auto& grid : grids()) {
        CellWorld world(tests::noise(grid), {"0:0.2", "0.4:0.45", "0.7:0.9"}, 0.7);
        world.scene.layers[1].style.color = ByValue{{}, 0.4, 0.45};
        world.scene.layers[2].style.color = ByValue{{}, 0.6, 1};
        world.scene.opacityPer = OpacityPer::Crossing;
        // Within a cell they come by their middles: where it is bent, a few rays meet two of them
        // the other way round.
        expectTheProcessorsInEveryLight(world.scene, 3e-4, 1.2e-2);
        world.scene.byMiddles = true;
        expectTheProcessorsInEveryLight(world.scene, 3e-4, 4e-3);
    }
}

// What is missing or clipped takes the part of each tetrahedron that is nearest to it.
TEST_F(GlTetsOf, PartsAreTheProcessors) {
    for (const auto& grid : grids()) {
        CellWorld world(tests::stepOf(grid,
                                      [](std::size_t i) {
                                          return i % 9 == 0
                                                     ? std::numeric_limits<double>::quiet_NaN()
                                                     : double(i * 7919 % 1000) / 1000;
                                      }),
                        {"0.3:0.6"});
        for (const Order order : {Order::None, Order::BackToFront}) {
            world.scene.order = order;
            world.scene.clip = {};
            expectTheProcessors(world.scene, kOutside, 1e-3);
            const auto whole = drawn(world.scene, kOutside);
            world.scene.clip.to.y = 1.6;
            expectTheProcessors(world.scene, kOutside, 1e-3);
            EXPECT_NE(drawn(world.scene, kOutside), whole);
        }
    }
}

TEST_F(GlTetsOf, WhatIsOpaqueHidesTheRestOfARay) {
    const CellWorld world(tests::noise(tests::twisted()), {"0.3:0.6"});
    const auto wall =
        static_cast<float>(windowDepth(kOutside, glm::length(glm::dvec3(1.2, -2.5, 1))));
    const std::vector<float> hides(std::size_t(kSize.x) * kSize.y, wall);
    const auto expected =
        drawn(world.scene, kOutside, Channels::Weight, 0, 2, tests::kAllCells, hides);
    expectSame(plane(world.scene, kOutside, Channels::Weight, 0, tests::kAllCells, wall), expected,
               3e-4);
    EXPECT_NE(drawn(world.scene, kOutside), expected) << "or nothing was hidden";
}

TEST_F(GlTetsOf, SmallOnesAreTheProcessorsMeansInAnySlices) {
    for (const auto& grid : grids()) {
        CellWorld world(tests::noise(grid), {"0.3:0.6"});
        inParts_ = grid->mesh()->solids() == nullptr;
        for (const Order order : {Order::None, Order::BackToFront}) {
            world.scene.order = order;
            const View view = lookFrom({20, -40, 20}, kSize);
            EXPECT_GT(raysAcross(world.scene, view), 1);
            expectTheProcessors(world.scene, view, 1e-3);
            const Channels channels = channelsFor(world.scene)[0];
            EXPECT_EQ(plane(world.scene, view, channels, 0, 1), plane(world.scene, view, channels));
        }
    }
}

// What is kept on the GPU is not taken for that of another grid of as many points, nor of another
// scale.
TEST_F(GlTetsOf, EachOfSeveralScenesIsItsOwn) {
    for (const auto& grid : grids()) {
        const CellWorld world(tests::noise(grid), {"0.3:0.6"});
        expectTheProcessors(world.scene, kOutside, 3e-4);
        CellWorld stretched(tests::noise(grid), {"0.3:0.6"});
        stretched.scene.cells = world.scene.cells;
        stretched.placed = PlacedPoints(*grid, glm::dvec3(1, 2, 0.5));
        expectTheProcessors(stretched.scene, kOutside, 3e-4);
        // Nor for that of the light which falls on them before there are gradients.
        CellWorld lit(tests::noise(grid), {"0.3:0.6"});
        lit.scene.order = Order::BackToFront;
        lit.scene.light = Light::Full;
        lit.scene.byMiddles = true;
        const auto gradients = std::exchange(lit.scene.gradients, nullptr);
        expectTheProcessors(lit.scene, kOutside, 3e-3);
        const auto own = drawn(lit.scene, kOutside, Channels::Over);
        lit.scene.gradients = gradients;
        expectTheProcessors(lit.scene, kOutside, 3e-3);
        EXPECT_NE(drawn(lit.scene, kOutside, Channels::Over), own);
    }
}

glm::dvec3 middleOf(const GlTet& t) {
    glm::dvec3 sum(0);
    for (int i = 1; i < 4; ++i) sum += glm::dvec3(t.corners[i]);
    return glm::dvec3(t.corners[0]) + sum / 4.0;
}

// Cell by cell, the farthest first, and so are those of a cell: to float, however far the eye is.
TEST_F(GlTetsOf, AreInOrderOfTheirCellsAndOfTheirOwn) {
    constexpr double kRounding = 4e-6;
    auto all = grids();
    all.push_back(tests::curvilinear({14, 14, 14}, [](double i, double j, double k) {
        return glm::dvec3(i, j + 0.1 * k, k * k / 14);
    }));
    for (const auto& grid : all) {
        CellWorld world(tests::noise(grid), {"0.2:0.6", "0.5:0.7"});
        world.scene.byMiddles = true;
        const auto pieces = whole(world.scene, GlCellSplatter::mostBytes(), lister_);
        const auto [first, end] = pieces->placesOf(Channels::Over, 0);
        const auto tets = tests::contentsOf<GlTet>(pieces->pieces(), end);
        ASSERT_GT(end, 500u);
        for (const double away : {0.2, 3.0, 1e7}) {
            const glm::dvec3 eye = away * glm::normalize(glm::dvec3(1.2, -2.5, 1));
            GlPieceOrder order;
            const auto places = tests::contentsOf<std::uint32_t>(
                *pieces->farthestFirst(world.scene, lookFrom(eye, kSize), order), end);
            std::vector<bool> seen(end);
            double cellBefore = 1e300, before = 1e300;
            for (std::uint32_t i = 0; i < end; ++i) {
                ASSERT_FALSE(seen[places[i]]) << "twice";
                seen[places[i]] = true;
                const GlTet& tet = tets[places[i]];
                const double cell = glm::distance(middleOfCell(world.scene, tet.cell), eye),
                             own = glm::distance(middleOf(tet), eye);
                ASSERT_LE(cell, cellBefore + kRounding * (1 + away * 1e-9));
                const GlTet* const last = i > 0 ? &tets[places[i - 1]] : nullptr;
                if (last && last->cell == tet.cell && last->kind >> 8 == tet.kind >> 8) {
                    ASSERT_LE(own, before + kRounding * (1 + away * 1e-9));
                }
                cellBefore = std::min(cell, cellBefore);
                before = own;
            }
        }
    }
}

// Cell by cell as the processor has them in order; of one cell the last layer first.
TEST_F(GlTetsOf, AreInTheProcessorsOrderOfCells) {
    for (const auto& grid : grids()) {
        const CellWorld world(tests::noise(grid), {"0.2:0.6", "0.5:0.7"});
        const auto pieces = whole(world.scene, GlCellSplatter::mostBytes(), lister_);
        const auto [first, end] = pieces->placesOf(Channels::Over, 0);
        const auto tets = tests::contentsOf<GlTet>(pieces->pieces(), end);
        const View view = lookFrom({1.2, -2.5, 1}, kSize);
        GlPieceOrder order;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> drawn, expected;
        for (const std::uint32_t place : tests::contentsOf<std::uint32_t>(
                 *pieces->farthestFirst(world.scene, view, order), end)) {
            const std::pair of(tets[place].cell, tets[place].kind >> 8);
            if (drawn.empty() || drawn.back() != of) drawn.push_back(of);
        }
        const CellRank rank(world.scene, view);
        const std::set has(drawn.begin(), drawn.end());
        for (const CellOfLayer& of : cellsOf(world.scene, Channels::Over, 0, &rank))
            if (has.contains({of.cell, of.layer})) expected.emplace_back(of.cell, of.layer);
        std::ranges::reverse(expected);
        ASSERT_GT(drawn.size(), 50u);
        EXPECT_EQ(drawn, expected);
    }
}

// A few cells at a time, as a window makes them at rest.
TEST_F(GlTetsOf, MadeInSlicesAreTheSame) {
    for (const auto& grid : grids()) {
        const CellWorld world(tests::noise(grid), {"0.2:0.6", "0.5:0.7"});
        const std::uint64_t most = GlCellSplatter::mostBytes();
        const auto atOnce = whole(world.scene, most, lister_),
                   slices = GlPieces::begin(world.scene, most, lister_);
        constexpr std::uint64_t kCells = 20;
        std::uint64_t calls = 1;
        double before = 0;
        for (double share; (share = slices->goOn(world.scene, kCells)) < 1; ++calls, before = share)
            EXPECT_GT(share, before);
        EXPECT_GT(calls, cellCount(world.scene, Channels::Over, 0) / kCells);
        EXPECT_GT(calls, 5u);
        for (std::size_t layer : {0, 1})
            EXPECT_EQ(slices->placesOf(Channels::Weight, layer),
                      atOnce->placesOf(Channels::Weight, layer));
        const std::size_t words =
            slices->placesOf(Channels::Over, 0).second * (sizeof(GlTet) / sizeof(std::uint32_t));
        EXPECT_EQ(tests::contentsOf<std::uint32_t>(slices->pieces(), words),
                  tests::contentsOf<std::uint32_t>(atOnce->pieces(), words));
        GlPieceOrder order;
        const View view = lookFrom({1.2, -2.5, 1}, kSize);
        const std::uint32_t count = slices->placesOf(Channels::Over, 0).second;
        EXPECT_EQ(tests::contentsOf<std::uint32_t>(*slices->farthestFirst(world.scene, view, order),
                                                   count),
                  tests::contentsOf<std::uint32_t>(*atOnce->farthestFirst(world.scene, view, order),
                                                   count));
    }
}

// 96 bytes each: six a cell of a curvilinear grid, of others as many as they have.
TEST_F(GlTetsOf, TakeNoMoreThanTheyMay) {
    for (const auto& grid : grids()) {
        CellWorld world(tests::noise(grid), {"min:max"});
        const auto pieces = whole(world.scene, GlPieces::bytesOf(world.scene), lister_);
        const auto [first, end] = pieces->placesOf(Channels::Weight, 0);
        EXPECT_LE(96 * (end - first), GlPieces::bytesOf(world.scene));
        if (grid->mesh()->solids()) {
            EXPECT_GT(96 * (end - first), GlPieces::bytesOf(world.scene) * 9 / 10);
        }
        EXPECT_THROW(whole(world.scene, 96 * (end - first) - 1, lister_), std::runtime_error);
    }
}

TEST_F(GlTetsOf, ValuesFarBeyondFloatsAreTheProcessors) {
    for (const auto& grid : grids()) {
        const auto scaled = [&](double by) {
            std::vector<double> values(grid->count());
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = by * (double(i * 7919 % 1000) / 1000);
            return tests::sorted({grid, std::move(values), {}});
        };
        expectTheProcessors(CellWorld(scaled(1e300), {"3e299:6e299"}).scene, kOutside, 3e-4);
        expectTheProcessors(CellWorld(scaled(1e-300), {"3e-301:6e-301"}).scene, kOutside, 3e-4);
        const CellWorld plateau(tests::stepOf(grid, [](std::size_t) { return 3.0; }), {"2:4"});
        expectTheProcessors(plateau.scene, kOutside, 3e-4);
    }
}

}  // namespace
}  // namespace render
