// Solid cells of unstructured grids, parted into tetrahedra.
#include "timeseries/grid/solid_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <random>

#include "tests/support/unstructured.h"

namespace timeseries {
namespace {

using tests::addCell;
using tests::bricks;
using tests::Cut;
using tests::kCuts;
using tests::renumbered;

glm::dvec3 plain(double i, double j, double k) { return {i, j, k}; }

double volumeOf(const UnstructuredGrid& grid, const std::array<std::uint32_t, 4>& tet) {
    const glm::dvec3& at = grid.points[tet[0]];
    return std::abs(glm::dot(grid.points[tet[1]] - at,
                             glm::cross(grid.points[tet[2]] - at, grid.points[tet[3]] - at))) /
           6;
}

// Where every face within is of two tetrahedra, and every other one on the box's sides, they fill
// the box: once, if that is their volume.
TEST(SolidCells, PartsOfEveryShapeFillTheirGridAndMeetFaceToFace) {
    std::mt19937 random(4);
    for (const Cut cut : kCuts)
        for (int turn = 0; turn < 5; ++turn) {
            const UnstructuredGrid grid = renumbered(tests::bentBricks(cut), random);
            const auto solids = SolidCells::of(grid, grid.points.size());
            ASSERT_TRUE(solids);
            ASSERT_EQ(solids->count(), grid.types.size());
            double volume = 0;
            std::map<std::array<std::uint32_t, 3>, int> faces;
            for (std::uint64_t cell = 0; cell < solids->count(); ++cell)
                solids->forEachTet(cell, [&](const std::array<std::uint32_t, 4>& tet) {
                    volume += volumeOf(grid, tet);
                    for (std::size_t out = 0; out < 4; ++out) {
                        std::array face{tet[(out + 1) % 4], tet[(out + 2) % 4], tet[(out + 3) % 4]};
                        std::ranges::sort(face);
                        ++faces[face];
                    }
                });
            EXPECT_NEAR(volume, 60, 1e-9);
            for (const auto& [face, times] : faces) {
                const auto& corners = face;
                const auto onSide = [&](int a, double side) {
                    return std::ranges::all_of(corners, [&](std::uint32_t point) {
                        return grid.points[point][a] == side;
                    });
                };
                const bool isOutside = onSide(0, 0) || onSide(0, 4) || onSide(1, 0) ||
                                       onSide(1, 3) || onSide(2, 0) || onSide(2, 5);
                ASSERT_EQ(times, isOutside ? 1 : 2);
            }
        }
}

// As an unstructured grid has them that lists each, and parted alike.
TEST(SolidCells, BetweenColumnsArePrisms) {
    const UnstructuredGrid grid = tests::bentBricks(Cut::Wedges);
    const std::uint64_t columns = 5 * 4, levels = 6;
    auto feet = std::make_shared<std::vector<SolidCells::Foot>>();
    const std::uint64_t each = grid.types.size() / (levels - 1);
    for (std::uint64_t cell = 0; cell < each; ++cell) {
        const auto corners = listOf(grid.corners, grid.ends, cell);
        feet->push_back({corners[0], corners[1], corners[2]});
    }
    const auto solids = SolidCells::of(grid, grid.points.size());
    const auto prisms = SolidCells::ofColumns(feet, columns, levels, solids->longest());
    ASSERT_TRUE(prisms);
    ASSERT_EQ(prisms->count(), solids->count());
    EXPECT_EQ(prisms->tets(), solids->tets());
    for (std::uint64_t cell = 0; cell < solids->count(); ++cell) {
        SolidCells::Room room, none;
        EXPECT_TRUE(std::ranges::equal(prisms->corners(cell, room), solids->corners(cell, none)));
        EXPECT_EQ(prisms->firstCorner(cell), std::ranges::min(prisms->corners(cell, room)));
        std::vector<std::array<std::uint32_t, 4>> one, other;
        prisms->forEachTet(cell, [&](const auto& tet) { one.push_back(tet); });
        solids->forEachTet(cell, [&](const auto& tet) { other.push_back(tet); });
        EXPECT_EQ(one, other);
    }
    EXPECT_EQ(*prisms, *SolidCells::ofColumns(feet, columns, levels, solids->longest()));
    EXPECT_NE(*prisms, *SolidCells::ofColumns(feet, columns, levels - 1, solids->longest()));
    // One level has nothing between; numbers of points and of cells have 32 bits.
    EXPECT_FALSE(SolidCells::ofColumns(feet, columns, 1, {}));
    EXPECT_FALSE(SolidCells::ofColumns(feet, std::uint64_t{1} << 31, 3, {}));
    EXPECT_FALSE(SolidCells::ofColumns(nullptr, columns, 2, {}));
}

// The way from 350 to 10 degrees is short, and that about a pole goes across it.
TEST(SolidCells, ColumnsAreApartTheShorterWay) {
    const std::vector<glm::dvec2> at{{350, 10}, {10, 12}, {0, 20}, {5, 88}, {125, 87}, {245, 89}};
    const auto placeOf = [&](std::uint32_t column) { return at[column]; };
    const std::vector<SolidCells::Foot> beside{{0, 1, 2}}, about{{3, 4, 5}};
    EXPECT_EQ(SolidCells::longestOf(beside, 360, placeOf), glm::dvec2(20, 10));
    EXPECT_EQ(SolidCells::longestOf(beside, 0, placeOf), glm::dvec2(350, 10));
    EXPECT_EQ(SolidCells::longestOf(about, 360, placeOf), glm::dvec2(0, 2 + 3));
}

// Each shape by itself, in every numbering of its corners: as large as its moments say.
TEST(SolidCells, PartsOfAShapeAreAsLargeAsTheShape) {
    const auto ring = [](int corners, double z) {
        std::vector<glm::dvec3> at;
        for (int i = 0; i < corners; ++i)
            at.emplace_back(std::cos(2 * M_PI * i / corners), std::sin(2 * M_PI * i / corners), z);
        return at;
    };
    const auto prism = [&](int corners) {
        auto at = ring(corners, 0);
        std::ranges::copy(ring(corners, 1.5), std::back_inserter(at));
        return at;
    };
    auto pyramid = ring(4, 0);
    pyramid.emplace_back(0.2, 0.1, 2);
    auto tetrahedron = ring(3, 0);
    tetrahedron.emplace_back(0.1, 0, 1);
    std::mt19937 random(9);
    for (const auto& [type, corners] :
         std::map<std::uint8_t, std::vector<glm::dvec3>>{{10, tetrahedron},
                                                         {12, prism(4)},
                                                         {13, prism(3)},
                                                         {14, pyramid},
                                                         {15, prism(5)},
                                                         {16, prism(6)}}) {
        UnstructuredGrid one;
        one.points.assign(corners.begin(), corners.end());
        one.types = {type};
        one.corners.resize(corners.size());
        std::iota(one.corners.begin(), one.corners.end(), 0u);
        one.ends = {corners.size()};
        for (int turn = 0; turn < 20; ++turn) {
            const UnstructuredGrid grid = renumbered(one, random);
            CellMoments moments;
            UnstructuredShapes(grid).measure(grid, 0, {&moments, 1});
            double volume = 0;
            SolidCells::of(grid, grid.points.size())->forEachTet(0, [&](const auto& tet) {
                volume += volumeOf(grid, tet);
            });
            EXPECT_NEAR(volume, moments.volume, 1e-12) << int(type);
        }
    }
}

// A file may list fewer points of a polyhedron than its faces have, or others.
TEST(SolidCells, CornersOfAPolyhedronAreThoseOfItsFaces) {
    UnstructuredGrid grid = bricks({2, 2, 2}, Cut::Polyhedra, plain);
    grid.points.emplace_back(9, 9, 9);
    grid.corners = {8, 3, 3};
    grid.ends = {3};
    ASSERT_EQ(flawOf(grid), "");
    const auto solids = SolidCells::of(grid, grid.points.size());
    ASSERT_TRUE(solids);
    SolidCells::Room room;
    const auto corners = solids->corners(0, room);
    EXPECT_EQ(std::vector(corners.begin(), corners.end()),
              (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
    double volume = 0;
    solids->forEachTet(0, [&](const auto& tet) { volume += volumeOf(grid, tet); });
    EXPECT_NEAR(volume, 1, 1e-12);
    EXPECT_EQ(solids->longest(), glm::dvec3(1));
    EXPECT_EQ(SolidCells::of(grid, 7), nullptr);
}

TEST(SolidCells, SurfacesAndPointsBesideThemAreLeftOut) {
    UnstructuredGrid grid;
    grid.points.resize(8);
    addCell(grid, 5, {0, 1, 2});
    addCell(grid, 1, {4});
    EXPECT_EQ(SolidCells::of(grid, 8), nullptr);
    addCell(grid, 10, {4, 5, 6, 7});
    addCell(grid, 200, {1});
    addCell(grid, 10, {0, 1, 2, 3});
    const auto solids = SolidCells::of(grid, 8);
    ASSERT_TRUE(solids);
    ASSERT_EQ(solids->count(), 2u);
    EXPECT_EQ(solids->firstCorner(0), 4u);
    // One that has no values at all of its corners is no cell.
    EXPECT_EQ(SolidCells::of(grid, 7)->count(), 1u);
}

// What lies between the corners is not a lattice's, and is not looked at.
TEST(SolidCells, OfCurvedCellsTheCornersCount) {
    UnstructuredGrid grid;
    grid.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}};
    addCell(grid, 24, {0, 1, 2, 3, 4, 4, 4, 4, 4, 4});
    const auto solids = SolidCells::of(grid, 5);
    ASSERT_TRUE(solids);
    int tets = 0;
    solids->forEachTet(0, [&](const auto& tet) {
        ++tets;
        EXPECT_NEAR(volumeOf(grid, tet), 1.0 / 6, 1e-15);
    });
    EXPECT_EQ(tets, 1);
    EXPECT_EQ(solids->longest(), glm::dvec3(1));
}

TEST(SolidCells, MeshesOfPointsAndOfCellsHaveThem) {
    const UnstructuredGrid grid = bricks({3, 3, 3}, Cut::Wedges, plain);
    ASSERT_TRUE(tests::atPoints(grid).solids());
    EXPECT_EQ(tests::atPoints(grid).solids()->count(), 16u);
    EXPECT_FALSE(tests::atPoints(grid).solids()->haveMiddles());
    EXPECT_EQ(tests::atPoints(grid).corners(), 27u);
    ASSERT_TRUE(tests::atCells(grid).solids());
    EXPECT_EQ(tests::atCells(grid).corners(), 16u + 27);
    // Their points alike, cells that are not make another mesh.
    EXPECT_EQ(tests::atPoints(grid), tests::atPoints(grid));
    UnstructuredGrid other = grid;
    std::swap(other.corners[1], other.corners[2]);
    EXPECT_FALSE(tests::atPoints(grid) == tests::atPoints(other));
    EXPECT_EQ(tests::atCells(grid), tests::atCells(grid));
    EXPECT_FALSE(tests::atCells(grid) == tests::atCells(other));
    other = grid;
    other.points.push_back({1, 1, 1});
    EXPECT_FALSE(tests::atCells(grid) == tests::atCells(other));
    // Columns above cells are none.
    EXPECT_FALSE(meshOfCells(grid, UnstructuredShapes(grid), {0, 1}).solids());
}

}  // namespace
}  // namespace timeseries
