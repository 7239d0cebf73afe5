// The order of a mesh's parts that no faces join, by what rays meet of them.
#include "render/splat/gap_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "tests/support/order_on_rays.h"
#include "tests/support/unstructured.h"

namespace render {
namespace gap_order {
namespace {

using tests::CellWorld;
using tests::listed;
using tests::Passed;
using tests::passed;
using tests::views;
using tests::wholeOf;
using timeseries::Grid;

void addBox(timeseries::UnstructuredGrid& grid, const glm::dvec3& lo, const glm::dvec3& hi) {
    const auto first = static_cast<std::uint32_t>(grid.points.size());
    for (unsigned c = 0; c < 8; ++c)
        grid.points.push_back({c & 1 ? hi.x : lo.x, c & 2 ? hi.y : lo.y, c & 4 ? hi.z : lo.z});
    tests::addCell(
        grid, 11,
        {first, first + 1, first + 2, first + 3, first + 4, first + 5, first + 6, first + 7});
}

// Parts that no face joins: boxes on a plate, sheets of cells of several sizes, and slats.
std::vector<std::shared_ptr<const Grid>> parts() {
    timeseries::UnstructuredGrid boxes, sheets, slats;
    addBox(boxes, {0, 0, 0}, {10, 10, 1});
    for (int i = 0; i < 25; ++i) {
        const glm::dvec3 at(2 * (i % 5) + 0.7, 2 * (i / 5) + 0.7, 1);
        addBox(boxes, at, at + glm::dvec3(0.6, 0.6, 0.6));
    }
    for (int k = 0; k < 3; ++k) {
        const int cells = std::array{1, 7, 3}[static_cast<std::size_t>(k)];
        const double side = 6.0 / cells;
        for (int i = 0; i < cells * cells; ++i) {
            const glm::dvec3 at(side * (i % cells), side * (i / cells), 0.3 * k);
            addBox(sheets, at, at + glm::dvec3(side, side, 0.1));
        }
    }
    for (int i = 0; i < 8; ++i) addBox(slats, {i, -0.5 * i, 0}, {i + 0.2, 9 - 2 * (i % 3), 2});
    return {tests::gridOf(tests::atPoints(boxes)), tests::gridOf(tests::atPoints(sheets)),
            tests::gridOf(tests::atPoints(slats))};
}

// All but a few of thousands, where a ray passes where two parts touch.
TEST(GapOrder, IsOfPartsThatNoFacesJoinAsRaysMeetThem) {
    Passed byRays, byMiddles;
    for (const auto& grid : parts()) {
        CellWorld world = wholeOf(grid);
        for (const View& view : views()) {
            const auto list = listed(world.scene, view);
            for (const auto& other :
                 {listed(world.scene, view, 1), listed(world.scene, view, 3, 5)})
                EXPECT_TRUE(
                    std::ranges::equal(list, other, {}, &CellOfLayer::cell, &CellOfLayer::cell));
            for (const bool isByMiddles : {false, true}) {
                world.scene.byMiddles = isByMiddles;
                (isByMiddles ? byMiddles : byRays) += passed(world, view);
            }
            world.scene.byMiddles = false;
        }
    }
    EXPECT_GT(byMiddles.wrong, 100u) << "this asks for nothing";
    EXPECT_LE(byRays.wrong, 2u);
    EXPECT_GT(byRays.inOrder, 2'000u);
}

// As an orthographic picture has it, which is a perspective from very far.
TEST(GapOrder, IsTheSameFromVeryFar) {
    Passed byRays;
    for (const auto& grid : parts()) {
        const CellWorld world = wholeOf(grid);
        for (View view : views()) {
            const glm::dvec3 eye = pixelRays(view).eye;
            constexpr double kFar = 1e4;
            view = tests::lookFrom(kFar * glm::normalize(eye), {16, 12});
            for (int c = 0; c < 2; ++c) view.clipFromView[c][c] *= kFar / 3;
            byRays += passed(world, view);
        }
    }
    EXPECT_LE(byRays.wrong, 4u);
    EXPECT_GT(byRays.inOrder, 1'000u);
}

}  // namespace
}  // namespace gap_order
}  // namespace render
