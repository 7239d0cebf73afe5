// Cells of unstructured grids that have the values themselves: what lies between their middles and
// their corners.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/reference/cell_pick.h"
#include "render/reference/interval_truth.h"
#include "render/reference/tets_on_pixels.h"
#include "tests/support/bent_grids.h"
#include "tests/support/cell_rays.h"
#include "tests/support/tets_of_world.h"

namespace render {
namespace cells_with_values {
namespace {

using tests::CellWorld;
using tests::drawn;
using tests::stepOfPlaces;
using tests::volumeOf;
using tests::cells::kFrom;
using tests::cells::kNan;
using tests::cells::pathThrough;
using timeseries::Grid;

// The box is 4 x 3 x 5. One that is missing takes all of itself away, and nothing of others.
TEST(CellsWithValues, FillTheirGridButForThoseThatAreMissing) {
    for (const auto& grid : tests::bentCells()) {
        EXPECT_NEAR(
            volumeOf(CellWorld(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"min:max"})),
            60, 1e-4);
        const auto isThere = [](std::uint64_t i) { return i % 3 != 1; };
        double expected = 0;
        for (std::uint64_t i = 0; i < grid->count(); ++i)
            if (isThere(i)) expected += grid->mesh()->volume(i);
        EXPECT_NEAR(
            volumeOf(CellWorld(
                tests::stepOf(grid, [&](std::size_t i) { return isThere(i) ? float(i) : kNan; }),
                {"min:max"})),
            expected, 1e-4);
    }
}

// 6 x 5 x 7 bricks in a box: between the outermost middles a field that is linear stays so. A range
// of it is a slab that reaches to the box's sides; ends of a range are ramps in a picture, a pixel
// wide.
TEST(CellsWithValues, ARangeOfALinearFieldIsASlab) {
    for (const tests::Cut cut :
         {tests::Cut::Hexahedra, tests::Cut::Voxels, tests::Cut::Polyhedra}) {
        const auto grid = tests::gridOf(
            tests::atCells(tests::bricks({7, 6, 8}, cut, [](double i, double j, double k) {
                return glm::dvec3(i, 2 * j, 0.5 * k);
            })));
        const auto byX = [](const auto& p) { return p.x; };
        for (const char* range : {"1.5:4.5", "2.1:2.7", "3~0.02"}) {
            CellWorld world(stepOfPlaces(grid, byX), {range});
            const auto& interval = world.scene.layers[0].cells.ranges.at(0);
            const PlacedPoints::Box slab{world.placed.axesFromGrid({interval.lo, 0, 0}),
                                         world.placed.axesFromGrid({interval.hi, 10, 3.5})};
            for (const glm::dvec3& from : kFrom) {
                const View view = tests::lookFrom(from, {40, 30}, 0.1);
                std::vector<glm::ivec2> pixels;
                for (int i = 0; i < 1200; ++i) pixels.emplace_back(i % 40, i / 40);
                const std::vector<double> truth = meshWeight(
                    world.scene, world.scene.cells->field(), view, 0, pixels, placesOfRays(1), 2);
                double off = 0, all = 0;
                const auto w = drawn(world.scene, view);
                for (std::size_t i = 0; i < pixels.size(); ++i) {
                    const double way = pathThrough(world, view, pixels[i].x, pixels[i].y, slab);
                    ASSERT_NEAR(truth[i], way, 1e-5) << range << " from " << from.x;
                    off += (double(w[i]) - way) * (double(w[i]) - way);
                    all += way * way;
                }
                EXPECT_GT(all, 1e-3);
                const bool isWide = interval.hi - interval.lo > 0.5;  // others are below a pixel
                EXPECT_LE(std::sqrt(off / all), isWide ? 3e-2 : 1.0) << range << " from " << from.x;
            }
        }
    }
}

// Their corners are where a globe has the file's.
TEST(CellsWithValues, LieOnAGlobe) {
    auto mesh = std::make_shared<const timeseries::Mesh>(tests::atCells(tests::bricks(
        {5, 4, 6}, tests::Cut::Hexahedra,
        [](double i, double j, double k) { return glm::dvec3(10 + i, 40 + j, 100 * k); })));
    const auto grid = std::make_shared<Grid>(
        std::array{timeseries::Axis{"lon", "degrees_east", {}},
                   timeseries::Axis{"lat", "degrees_north", {}}, timeseries::Axis{"z", "m", {}}},
        mesh);
    const CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.y; }), {"min:max"}, 0.5,
                          Map::Globe);
    ASSERT_TRUE(world.placed.globe());
    ASSERT_EQ(world.placed.mesh()->corners(), mesh->corners());
    for (std::uint64_t corner = 0; corner < mesh->corners(); ++corner) {
        const glm::dvec3 at =
            world.placed.axesFromGlobe(world.placed.globe()->at(mesh->cornerPosition(corner)));
        EXPECT_LT(glm::distance(world.placed.cornerAlongAxes(corner), at), 1e-6);
    }
    EXPECT_GT(volumeOf(world), 0);
}

// What a cell has is told of the cell under the cursor.
TEST(CellsWithValues, ACellIsSeenUnderTheCursor) {
    for (const auto& grid : tests::bentCells()) {
        const CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"1.7~0.001"},
                              1.0);
        const auto picked =
            pickCell(world.scene, tests::lookFrom({3, 0.1, 0.2}, {21, 21}, 0.05), {10.5, 10.5});
        ASSERT_TRUE(picked);
        EXPECT_NEAR(*picked->between, 1.7, 2e-3);
        ASSERT_LT(picked->gridIndex, grid->count());
        EXPECT_EQ(timeseries::toDouble(picked->value),
                  double(float(grid->position(picked->gridIndex).x)));
        EXPECT_NEAR(timeseries::toDouble(picked->value), 1.7, 1.01);
    }
}

}  // namespace
}  // namespace cells_with_values
}  // namespace render
