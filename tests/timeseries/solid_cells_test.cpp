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

glm::dvec3 plain(double i, double j, double k) { return {i, j, k}; }

// The same cells of points that are numbered otherwise.
UnstructuredGrid renumbered(const UnstructuredGrid& grid, std::mt19937& random) {
    std::vector<std::uint32_t> to(grid.points.size());
    std::iota(to.begin(), to.end(), 0u);
    std::ranges::shuffle(to, random);
    UnstructuredGrid out = grid;
    for (std::size_t i = 0; i < to.size(); ++i) out.points[to[i]] = grid.points[i];
    for (std::uint32_t& corner : out.corners) corner = to[corner];
    for (std::size_t cell = 0; cell < grid.faceEnds.size(); ++cell)
        for (std::size_t at = (cell == 0 ? 0 : grid.faceEnds[cell - 1]) + 1;
             at < grid.faceEnds[cell]; at += 1 + grid.faces[at])
            for (std::size_t i = 1; i <= grid.faces[at]; ++i)
                out.faces[at + i] = to[grid.faces[at + i]];
    return out;
}

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

// As above, but that a cell's middle is a corner of all of its parts. Nodes are numbered on from
// the last cell, and faces between two cells are parted alike.
TEST(SolidCells, AboutMiddlesTheyFillTheirGridAndMeetFaceToFace) {
    std::mt19937 random(4);
    for (const Cut cut : kCuts)
        for (int turn = 0; turn < 5; ++turn) {
            const UnstructuredGrid grid = renumbered(tests::bentBricks(cut), random);
            const Mesh mesh = tests::atCells(grid);
            const auto cells = static_cast<std::uint32_t>(grid.types.size());
            ASSERT_TRUE(mesh.solids());
            const SolidCells& solids = *mesh.solids();
            ASSERT_EQ(solids.count(), cells);
            ASSERT_EQ(solids.firstNode(), cells);
            EXPECT_EQ(solids.longest(), SolidCells::of(grid, grid.points.size())->longest());
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
                    volume += std::abs(glm::dot(at[1] - at[0],
                                                glm::cross(at[2] - at[0], at[3] - at[0]))) /
                              6;
                    ++tets;
                    std::array face{tet[1], tet[2], tet[3]};
                    std::ranges::sort(face);
                    ++faces[face];
                });
            }
            EXPECT_EQ(tets, solids.tets());
            EXPECT_NEAR(volume, 60, 1e-4);
            for (const auto& [face, times] : faces) {
                const auto& corners = face;
                const auto onSide = [&](int a, double side) {
                    return std::ranges::all_of(corners, [&](std::uint32_t corner) {
                        return grid.points[corner - cells][a] == side;
                    });
                };
                const bool isOutside = onSide(0, 0) || onSide(0, 4) || onSide(1, 0) ||
                                       onSide(1, 3) || onSide(2, 0) || onSide(2, 5);
                ASSERT_EQ(times, isOutside ? 1 : 2);
            }
        }
}

// Also where places differ by what rounding leaves; points that only nearly meet stay apart.
TEST(SolidCells, AboutMiddlesPartsShareTheNodesWhereTheyMeet) {
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

void expectTwoSizesToMeet(bool areVoxels) {
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
    const Mesh mesh = tests::atCells(grid);
    const SolidCells& solids = *mesh.solids();
    const auto cells = static_cast<std::uint32_t>(grid.types.size());
    double volume = 0;
    std::map<std::array<std::uint32_t, 3>, int> faces;
    for (std::uint32_t cell = 0; cell < cells; ++cell)
        solids.forEachTet(cell, [&](const std::array<std::uint32_t, 4>& tet) {
            EXPECT_EQ(tet[0], cell);
            std::array<glm::dvec3, 4> at;
            for (std::size_t i = 0; i < 4; ++i) at[i] = mesh.cornerPosition(tet[i]);
            volume +=
                std::abs(glm::dot(at[1] - at[0], glm::cross(at[2] - at[0], at[3] - at[0]))) / 6;
            const glm::dvec3 area = glm::cross(at[2] - at[1], at[3] - at[1]);
            if (glm::length(area) < 1e-6) return;  // points of an edge
            std::array face{tet[1], tet[2], tet[3]};
            std::ranges::sort(face);
            ++faces[face];
        });
    EXPECT_NEAR(volume, 1, 1e-6);
    for (const auto& [face, times] : faces) {
        const auto& corners = face;
        const auto onSide = [&](int a, double of) {
            return std::ranges::all_of(corners, [&](std::uint32_t corner) {
                return std::abs(grid.points[corner - cells][a] - of) < 1e-9;
            });
        };
        const bool isOutside = onSide(0, 0) || onSide(0, 1) || onSide(1, 0) || onSide(1, 1) ||
                               onSide(2, 0) || onSide(2, 1);
        EXPECT_EQ(times, isOutside ? 1 : 2);
    }
}

// Of bricks of two sizes, some of the large ones beside an edge alone, the faces that meet are the
// same; all name points of their own.
TEST(SolidCells, AboutMiddlesBricksOfTwoSizesMeetFaceToFace) {
    for (const bool areVoxels : {true, false}) expectTwoSizesToMeet(areVoxels);
}

// Of one that crosses itself the centroid may lie far away, and collapsed ones name nodes twice.
TEST(SolidCells, MiddlesAreInTheirCellsAndNodesOnce) {
    UnstructuredGrid grid = bricks({3, 3, 3}, Cut::Hexahedra, plain);
    grid.points.emplace_back(1.05, 0, 0);
    auto corners = std::span(grid.corners).first(8);
    std::swap(corners[1], corners[2]);
    corners[0] = 27;
    const Mesh mesh = tests::atCells(grid);
    for (int a = 0; a < 3; ++a) {
        EXPECT_GE(mesh.position(0)[a], 0);
        EXPECT_LE(mesh.position(0)[a], 1.05);
        EXPECT_LE(mesh.widest()[a], 2);
    }
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
TEST(SolidCells, BoundsAreOfTheNodesThatCellsHave) {
    UnstructuredGrid grid = bricks({3, 4, 5}, Cut::Wedges, plain);
    grid.points.emplace_back(1e6, 0, 1e300);
    const Mesh::Box box = tests::atCells(grid).cornersBox();
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(box.lo[a], 0, 1e-5);
        EXPECT_NEAR(box.hi[a], 2 + a, 1e-5);
    }
}

// Of a list of corners that goes on behind the last cell's, the rest is nobody's.
TEST(SolidCells, AboutMiddlesCornersOfNoCellAreNobodys) {
    for (const Cut cut : {Cut::Tetrahedra, Cut::Voxels}) {
        const UnstructuredGrid grid = tests::bentBricks(cut);
        UnstructuredGrid more = grid;
        more.inParts = true;
        for (int i = 0; i < 1000; ++i) more.corners.push_back(kNoPoint);
        EXPECT_TRUE(SolidCells::aboutMiddles(more)->joinsAs(*SolidCells::aboutMiddles(grid)));
    }
}

// Whose numbers then are not those of the solids.
TEST(SolidCells, AboutMiddlesKnowTheirNumbersInTheFile) {
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
