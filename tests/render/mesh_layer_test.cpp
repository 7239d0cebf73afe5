// Cells of a mesh that is one layer of points.
#include "render/splat/mesh_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/support/cell_worlds.h"
#include "tests/support/meshes.h"

namespace render {
namespace {

// Of one layer, whose lines end where they began: both ends have half of the volume there.
TEST(MeshLayer, IsAsThickWhereItCloses) {
    const auto grid = tests::curvilinear({25, 5, 1}, [](double i, double j, double) {
        const double angle = i * std::numbers::pi / 12, r = 3 + j;
        return glm::dvec3(r * std::cos(angle), r * std::sin(angle), 0);
    });
    const tests::CellWorld world(tests::stepOf(grid, [](std::size_t i) { return double(i % 25); }),
                                 {"0:40"}, 0.5);
    const auto& corners = world.scene.cells->cornersOf();
    const MeshCells cells(world.placed, corners, world.scene.clip);
    const glm::uvec3 size = corners.size();
    double thickness = 0;
    for (unsigned y = 1; y + 1 < size.y; ++y)
        for (unsigned x = 1; x + 1 < size.x; ++x) {
            const auto cell = cells({x, y, 0});
            ASSERT_TRUE(cell);
            for (unsigned c = 0; c < 4; ++c) {
                const double is = glm::distance(cell->at[c], cell->at[c + 4]);
                if (thickness == 0) thickness = is;
                EXPECT_NEAR(is, thickness, 1e-5 * thickness) << x << ' ' << y << ' ' << c;
            }
        }
    EXPECT_GT(thickness, 0);
}

// Nobody knows how far its cells reach, from which nothing may follow: not from any side.
TEST(MeshLayer, IsSeenFromEverySide) {
    const auto grid = tests::curvilinear(
        {9, 8, 1}, [](double i, double j, double) { return glm::dvec3(i, j, 0); });
    const tests::CellWorld world(tests::stepOf(grid, [](std::size_t i) { return double(i % 9); }),
                                 {"0:40"}, 0.5);
    for (const glm::dvec3& from : {glm::dvec3(0, -3, 1), glm::dvec3(1e-4, -3, 1),
                                   glm::dvec3(-3, 0, 1), glm::dvec3(0, -3, 0.5)}) {
        const auto w = tests::drawn(world.scene, tests::lookFrom(from, {40, 30}));
        EXPECT_GT(std::ranges::count_if(w, [](float v) { return v > 0; }), 50) << from.x;
    }
}

}  // namespace
}  // namespace render
