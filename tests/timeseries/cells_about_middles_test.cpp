// Solid cells that have the values themselves, parted about their middles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <span>
#include <vector>

#include "tests/support/unstructured.h"
#include "timeseries/grid/grid.h"
#include "timeseries/grid/solid_cells.h"

namespace timeseries {
namespace cells_about_middles {
namespace {

using tests::addCell;
using tests::bricks;
using tests::Cut;
using tests::kCuts;
using tests::renumbered;

constexpr auto kPlain = [](double i, double j, double k) { return glm::dvec3(i, j, k); };

// What their tetrahedra fill, each about its cell's middle: a box as large as this, once. Triangles
// between two cells are of both, and those on the box's sides of one; some, of points of an edge,
// have no area.
void expectToFill(const UnstructuredGrid& grid, const glm::dvec3& size) {
    const Mesh mesh = tests::atCells(grid);
    ASSERT_TRUE(mesh.solids());
    const SolidCells& solids = *mesh.solids();
    const auto cells = static_cast<std::uint32_t>(grid.types.size());
    ASSERT_EQ(solids.count(), cells);
    ASSERT_EQ(solids.firstNode(), cells);
    double volume = 0;
    std::uint64_t tets = 0;
    std::map<std::array<std::uint32_t, 3>, int> faces;
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
        EXPECT_EQ(solids.middle(cell), cell);
        EXPECT_EQ(solids.firstCorner(cell), cell);
        solids.forEachTet(cell, [&](const std::array<std::uint32_t, 4>& tet) {
            EXPECT_EQ(tet[0], cell);
            EXPECT_GE(*std::min_element(tet.begin() + 1, tet.end()), cells);
            std::array<glm::dvec3, 4> at;
            for (std::size_t i = 0; i < 4; ++i) at[i] = mesh.cornerPosition(tet[i]);
            volume +=
                std::abs(glm::dot(at[1] - at[0], glm::cross(at[2] - at[0], at[3] - at[0]))) / 6;
            ++tets;
            if (glm::length(glm::cross(at[2] - at[1], at[3] - at[1])) < 1e-6) return;
            std::array face{tet[1], tet[2], tet[3]};
            std::ranges::sort(face);
            ++faces[face];
        });
    }
    EXPECT_EQ(tets, solids.tets());
    EXPECT_NEAR(volume, size.x * size.y * size.z, 2e-6 * size.x * size.y * size.z);
    for (const auto& [face, times] : faces) {
        const auto& corners = face;
        const auto onSide = [&](int a, double side) {
            return std::ranges::all_of(corners, [&](std::uint32_t corner) {
                return std::abs(grid.points[corner - cells][a] - side) < 1e-9;
            });
        };
        bool isOutside = false;
        for (int a = 0; a < 3; ++a) isOutside = isOutside || onSide(a, 0) || onSide(a, size[a]);
        ASSERT_EQ(times, isOutside ? 1 : 2);
    }
}

// Nodes are numbered on from the last cell, however the file numbers them.
TEST(CellsAboutMiddles, FillTheirGridAndMeetFaceToFace) {
    std::mt19937 random(4);
    for (const Cut cut : kCuts)
        for (int turn = 0; turn < 5; ++turn) {
            const UnstructuredGrid grid = renumbered(tests::bentBricks(cut), random);
            expectToFill(grid, {4, 3, 5});
            EXPECT_EQ(SolidCells::aboutMiddles(grid)->longest(),
                      SolidCells::of(grid, grid.points.size())->longest());
        }
}

// Also where places differ by what rounding leaves; points that only nearly meet stay apart.
TEST(CellsAboutMiddles, OfPartsShareTheNodesWhereTheyMeet) {
    for (const Cut cut : {Cut::Tetrahedra, Cut::Polyhedra}) {
        const UnstructuredGrid whole = tests::bentBricks(cut);
        const auto nodes = static_cast<std::uint32_t>(whole.points.size());
        UnstructuredGrid parts = whole;
        parts.inParts = true;
        for (const glm::dvec3& at : whole.points) parts.points.push_back(at * (1 + 1e-15));
        const auto move = [&](std::size_t cell, std::uint32_t& corner) {
            if (cell % 2 == 1) corner += nodes;
        };
        for (std::size_t cell = 0; cell < whole.types.size(); ++cell) {
            for (std::uint64_t i = cell == 0 ? 0 : whole.ends[cell - 1]; i < whole.ends[cell]; ++i)
                move(cell, parts.corners[i]);
            if (whole.faceEnds.empty()) continue;
            for (std::size_t at = (cell == 0 ? 0 : whole.faceEnds[cell - 1]) + 1;
                 at < whole.faceEnds[cell]; at += 1 + whole.faces[at])
                for (std::size_t i = 1; i <= whole.faces[at]; ++i) move(cell, parts.faces[at + i]);
        }
        ASSERT_EQ(flawOf(parts), "");
        EXPECT_EQ(tests::nodesOf(tests::atCells(parts)), nodes);
        for (std::uint32_t i = nodes; i < 2 * nodes; ++i) parts.points[i] *= 1 + 1e-8;
        EXPECT_GT(tests::nodesOf(tests::atCells(parts)), nodes + nodes / 2);
    }
}

// Of bricks of two sizes, some of the large ones beside an edge alone, that name points of their
// own each.
TEST(CellsAboutMiddles, OfTwoSizesMeetFaceToFace) {
    for (const bool areVoxels : {true, false}) {
        UnstructuredGrid grid;
        const auto add = [&](const glm::dvec3& at, double side) {
            const auto first = static_cast<std::uint32_t>(grid.points.size());
            for (int n = 0; n < 8; ++n)
                grid.points.push_back(at + side * glm::dvec3(n & 1, n >> 1 & 1, n >> 2));
            const std::uint32_t a = areVoxels ? 2 : 3, b = areVoxels ? 3 : 2;
            addCell(grid, areVoxels ? 11 : 12,
                    {first, first + 1, first + a, first + b, first + 4, first + 5, first + 4 + a,
                     first + 4 + b});
        };
        const double side = 1.0 / 3;
        for (int n = 0; n < 27; ++n) {
            const glm::dvec3 at(n % 3, n / 3 % 3, n / 9);
            if (n != 13) add(side * at, side);
        }
        for (int n = 0; n < 64; ++n)  // of the fourth part
            add(side * (glm::dvec3(1) + glm::dvec3(n % 4, n / 4 % 4, n / 16) / 4.0), side / 4);
        expectToFill(grid, {1, 1, 1});
    }
}

// A hexahedron whose upper face is the mirror image of the lower one, and a little smaller: as much
// of it is inside out as not, but for a hundredth, and what is divided by that lies far away.
TEST(CellsAboutMiddles, HaveThemWithinAlsoWhereTheyCrossThemselves) {
    constexpr double kSmaller = 0.99;
    UnstructuredGrid grid = bricks({3, 3, 3}, Cut::Hexahedra, kPlain);
    const auto first = static_cast<std::uint32_t>(grid.points.size());
    for (const glm::dvec3& at : {glm::dvec3(0, 0, 0),
                                 {1, 0, 0},
                                 {1, 1, 0},
                                 {0, 1, 0},
                                 {0, 0, 1},
                                 {0, 1, 1},
                                 {1, 1, 1},
                                 {1, 0, 1}})
        grid.points.push_back(at * (at.z > 0 ? glm::dvec3(kSmaller, kSmaller, 1) : glm::dvec3(1)));
    addCell(grid, 12,
            {first, first + 1, first + 2, first + 3, first + 4, first + 5, first + 6, first + 7});
    CellMoments moments;
    UnstructuredShapes(grid).measure(grid, 8, {&moments, 1});
    ASSERT_GT(glm::distance(moments.centroid, glm::dvec3(0.5)), 5) << "this asks for nothing";
    const Mesh mesh = tests::atCells(grid);
    for (int a = 0; a < 3; ++a) {
        EXPECT_GE(mesh.position(8)[a], 0);
        EXPECT_LE(mesh.position(8)[a], 1);
        EXPECT_LE(mesh.widest()[a], 2);
    }
}

TEST(CellsAboutMiddles, HaveNodesOnceAlsoWhereTheyCollapse) {
    UnstructuredGrid grid = bricks({3, 3, 3}, Cut::Hexahedra, kPlain);
    auto corners = std::span(grid.corners).first(8);
    corners[1] = corners[2];
    const auto solids = SolidCells::aboutMiddles(grid);
    std::vector<std::uint32_t> nodes;
    solids->forEachNode(0, [&](std::uint32_t node) { nodes.push_back(node); });
    EXPECT_EQ(nodes.size(), 7u);
    EXPECT_EQ(std::ranges::count(nodes, corners[1] + 8), 1);
    nodes.clear();
    solids->forEachNode(1, [&](std::uint32_t node) { nodes.push_back(node); });
    EXPECT_EQ(nodes.size(), 8u);
}

// What no cell has may lie anywhere.
TEST(CellsAboutMiddles, AreAsFarAsTheNodesThatTheyHave) {
    UnstructuredGrid grid = bricks({3, 4, 5}, Cut::Wedges, kPlain);
    grid.points.emplace_back(1e6, 0, 1e300);
    const Mesh::Box box = tests::atCells(grid).cornersBox();
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(box.lo[a], 0, 1e-5);
        EXPECT_NEAR(box.hi[a], 2 + a, 1e-5);
    }
}

// The box that a series is framed by, also of one cell, whose middle has no extent.
TEST(CellsAboutMiddles, LieInTheBoxOfTheirGrid) {
    const UnstructuredGrid cells = bricks({2, 2, 2}, Cut::Hexahedra, kPlain);
    const Grid one(spaceAxes(), std::make_shared<const Mesh>(tests::atCells(cells)));
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(one.ends(a).least, 0, 1e-6);
        EXPECT_NEAR(one.ends(a).most, 1, 1e-6);
    }
}

// Of a list of corners that goes on behind the last cell's, the rest is nobody's.
TEST(CellsAboutMiddles, CornersOfNoCellAreNobodys) {
    for (const Cut cut : {Cut::Tetrahedra, Cut::Voxels}) {
        const UnstructuredGrid grid = tests::bentBricks(cut);
        UnstructuredGrid more = grid;
        more.inParts = true;
        for (int i = 0; i < 1000; ++i) more.corners.push_back(kNoPoint);
        EXPECT_TRUE(SolidCells::aboutMiddles(more)->joinsAs(*SolidCells::aboutMiddles(grid)));
    }
}

// Surfaces and points beside them are left out, so that solids have other numbers than cells.
TEST(CellsAboutMiddles, KnowTheirNumbersInTheFile) {
    UnstructuredGrid grid;
    grid.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    addCell(grid, 5, {0, 1, 2});
    addCell(grid, 10, {0, 1, 2, 3});
    addCell(grid, 1, {4});
    addCell(grid, 10, {4, 1, 2, 3});
    const auto solids = SolidCells::aboutMiddles(grid);
    ASSERT_TRUE(solids);
    ASSERT_EQ(solids->count(), 2u);
    EXPECT_EQ(solids->middle(0), 1u);
    EXPECT_EQ(solids->middle(1), 3u);
    SolidCells::Room room;
    const auto corners = solids->corners(1, room);
    EXPECT_EQ(std::vector(corners.begin(), corners.end()),
              (std::vector<std::uint32_t>{4 + 4, 4 + 1, 4 + 2, 4 + 3, 3}));
    grid.types.assign(4, 5);
    EXPECT_EQ(SolidCells::aboutMiddles(grid), nullptr) << "surfaces";
    EXPECT_EQ(SolidCells::aboutMiddles({}), nullptr);
}

}  // namespace
}  // namespace cells_about_middles
}  // namespace timeseries
