// Cells that name their corners: where they lie and what they stand for.
#include "timeseries/grid/unstructured.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "tests/support/unstructured.h"
#include "timeseries/grid/scattered.h"
#include "timeseries/grid/solid_cells.h"

namespace timeseries {
namespace {

using tests::addCell;
using tests::bent;
using tests::bentBricks;
using tests::bricks;
using tests::Cut;
using tests::kCuts;
using tests::volume;

TEST(Unstructured, CellsAndPointsTakeTheSpaceThatThereIs) {
    for (const Cut cut : kCuts) {
        const UnstructuredGrid grid = bentBricks(cut);
        ASSERT_EQ(flawOf(grid), "");
        for (const Mesh& mesh : {tests::atCells(grid), tests::atPoints(grid)}) {
            EXPECT_NEAR(volume(mesh), 60, 1e-5);
            EXPECT_NEAR(double(mesh.meanVolume()) * double(mesh.count()), 60, 1e-9);
            EXPECT_EQ(mesh.flat() + mesh.folded() + mesh.absent(), 0u);
            EXPECT_FALSE(mesh.hasNeighbours());
        }
        // Where the mass lies, moments tell exactly, too: of cells at their centroids.
        const Mesh cells = tests::atCells(grid);
        glm::dvec3 middle(0);
        for (std::uint64_t i = 0; i < cells.count(); ++i)
            middle += volume(cells, i) / 60 * cells.position(i);
        EXPECT_NEAR(glm::distance(middle, glm::dvec3(2, 1.5, 2.5)), 0, 1e-5);
    }
}

// J J^T = L L^T, of bricks that lean.
TEST(Unstructured, ABrickReachesAsFarAsItsSides) {
    const glm::dmat3 steps({2, 0.5, 0}, {-0.4, 1, 0.3}, {0.1, 0.2, 3});
    const glm::dmat3 expected = steps * glm::transpose(steps);
    for (const Cut cut : {Cut::Hexahedra, Cut::Voxels}) {
        const UnstructuredGrid grid = bricks({4, 4, 4}, cut, [&](double i, double j, double k) {
            return steps * glm::dvec3(i, j, k);
        });
        const Mesh cells = tests::atCells(grid), points = tests::atPoints(grid);
        EXPECT_EQ(cells.spread(), 1);
        const auto expectSteps = [&](const Mesh& mesh, std::uint64_t index) {
            const auto rows = mesh.cell(index).rows();
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b)
                    EXPECT_NEAR(glm::dot(rows[a], rows[b]), expected[a][b],
                                0x1p-7 * std::sqrt(expected[a][a] * expected[b][b]));
        };
        for (std::uint64_t i = 0; i < cells.count(); ++i) expectSteps(cells, i);
        expectSteps(points, 1 + 4 * (2 + 4 * 1));  // inside: its star is twice a brick
    }
}

TEST(Unstructured, TheOrderOfCellsAndOfTheirCornersChangesNothing) {
    const UnstructuredGrid grid = bentBricks(Cut::Tetrahedra);
    std::vector<std::size_t> order(grid.types.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::shuffle(order, std::mt19937(7));
    UnstructuredGrid other;
    other.points = grid.points;
    for (const std::size_t cell : order)
        addCell(other, 10,
                {grid.corners[4 * cell + 1], grid.corners[4 * cell],  // turned inside out
                 grid.corners[4 * cell + 2], grid.corners[4 * cell + 3]});
    const Mesh a = tests::atCells(grid), b = tests::atCells(other);
    for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_NEAR(glm::distance(b.position(i), a.position(order[i])), 0, 1e-6);
        EXPECT_NEAR(volume(b, i), volume(a, order[i]), 1e-6);
    }
    const Mesh p = tests::atPoints(grid), q = tests::atPoints(other);
    for (std::uint64_t i = 0; i < p.count(); ++i) EXPECT_NEAR(volume(q, i), volume(p, i), 1e-6);
}

// Cells of one kind, many or few one behind the other, are measured side by side.
TEST(Unstructured, ACellMeasuresTheSameWhateverStandsBesideIt) {
    std::mt19937 random(17);
    const auto lists = [](const auto& all, const auto& ends, std::size_t cell) {
        const auto begin = all.begin();
        return std::vector<std::uint32_t>(begin + std::ptrdiff_t(cell == 0 ? 0 : ends[cell - 1]),
                                          begin + std::ptrdiff_t(ends[cell]));
    };
    UnstructuredGrid mixed;
    mixed.points = bentBricks(Cut::Voxels).points;
    std::vector<glm::dvec3> places;
    std::vector<double> volumes;
    for (int round = 0; round < 300; ++round) {
        const UnstructuredGrid grid = bentBricks(kCuts[random() % kCuts.size()]);
        const Mesh alone = tests::atCells(grid);
        for (auto run = random() % 3 == 0 ? random() % 100 : 1; run > 0; --run) {
            const std::size_t cell = random() % grid.types.size();
            const auto corners = lists(grid.corners, grid.ends, cell);
            mixed.types.push_back(grid.types[cell]);
            mixed.corners.insert(mixed.corners.end(), corners.begin(), corners.end());
            mixed.ends.push_back(mixed.corners.size());
            if (!grid.faces.empty()) {
                const auto faces = lists(grid.faces, grid.faceEnds, cell);
                mixed.faces.insert(mixed.faces.end(), faces.begin(), faces.end());
            }
            mixed.faceEnds.push_back(mixed.faces.size());
            places.push_back(alone.position(cell));
            volumes.push_back(volume(alone, cell));
        }
    }
    ASSERT_EQ(flawOf(mixed), "");
    ASSERT_GT(mixed.types.size(), 4000u);
    const Mesh mesh = tests::atCells(mixed);
    for (std::uint64_t i = 0; i < mesh.count(); ++i) {
        EXPECT_NEAR(glm::distance(mesh.position(i), places[i]), 0, 1e-6);
        // Beside bricks splats of irregular cells are wider: the cells are the same.
        EXPECT_NEAR(volume(mesh, i), volumes[i], 1e-6);
    }
}

// Centroids of a layer whose corners lie at -0.05 and 0.05, but for the last bits of these.
TEST(Unstructured, OneLayerOfSurfacesHasNoExtentAcross) {
    for (const double bits : {1e-17, 0.01}) {
        const auto grid = bricks({4, 4, 2}, Cut::Hexahedra, [&](double i, double j, double k) {
            return glm::dvec3(i, j, 0.1 * (k - 0.5) + bits * (i + j));
        });
        UnstructuredGrid below;
        below.points = grid.points;
        for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
            const auto of = listOf(grid.corners, grid.ends, cell);
            addCell(below, 9, {of[0], of[1], of[2], of[3]});
        }
        const auto mesh = std::make_shared<const Mesh>(tests::atCells(below));
        EXPECT_GT(mesh->hi().z, mesh->lo().z);
        const Grid of(spaceAxes(), mesh);
        EXPECT_EQ(of.axes()[0].coordinates.size(), 2u);
        EXPECT_EQ(of.axes()[2].coordinates.size(), bits < 1e-10 ? 1u : 2u);
        // Solids reach as far as their corners.
        EXPECT_EQ(Grid(spaceAxes(), std::make_shared<const Mesh>(tests::atCells(grid)))
                      .axes()[2]
                      .coordinates.size(),
                  2u);
    }
}

TEST(Unstructured, CellsOfFewerDimensionsThanOthersTakeNoSpace) {
    UnstructuredGrid grid = bricks({2, 2, 2}, Cut::Hexahedra, [](double i, double j, double k) {
        return glm::dvec3(i, j, k);
    });
    addCell(grid, 5, {0, 1, 2});
    addCell(grid, 3, {0, 7});
    addCell(grid, 1, {4});
    addCell(grid, 0, {});     // VTK's empty cell
    addCell(grid, 200, {1});  // no cell that is known
    ASSERT_EQ(flawOf(grid), "");
    const Mesh cells = tests::atCells(grid);
    EXPECT_EQ(cells.count(), 6u);
    EXPECT_EQ(cells.flat(), 4u);
    EXPECT_EQ(cells.absent(), 1u) << "the empty one lies nowhere";
    EXPECT_NEAR(volume(cells), 1, 1e-6);
    EXPECT_NEAR(volume(tests::atPoints(grid)), 1, 1e-6);
}

TEST(Unstructured, PointsWithoutACellOrWithAFlatOneAreTold) {
    const auto at = [](double i, double j, double k) { return glm::dvec3(i, j, k); };
    UnstructuredGrid grid = bricks({3, 2, 2}, Cut::Hexahedra, at);
    ASSERT_TRUE(notesOf(tests::atPoints(grid)).empty());
    grid.points.push_back({9, 9, 9});
    grid.points.push_back({9, 9, 9.5});
    grid.points.push_back({std::nan(""), 0, 0});  // no place, and no cell either
    grid.points.push_back({4, 0, 0});             // of a flat tetrahedron alone
    addCell(grid, 10, {0, 1, 3, 15});             // z = 0
    addCell(grid, 5, {0, 1, 6});                  // a surface beside solids takes no space anyway
    ASSERT_EQ(flawOf(grid), "");
    using testing::ElementsAre;
    EXPECT_THAT(notesOf(tests::atPoints(grid)),
                ElementsAre("1 of 16 points are not drawn: the file gives them no place",
                            "2 of 16 points are not drawn: they are corners of no cell",
                            "1 of 16 points are not drawn: their cells have no volume",
                            "3 of 16 points are corners of cells without a volume, too: they "
                            "stand for the others"));
    EXPECT_THAT(notesOf(tests::atCells(grid)),
                ElementsAre("2 of 4 points are not drawn: their cells have no volume"));
}

// As nodes that a mesher left over, at places that stand for none.
TEST(Unstructured, PointsOfNoCellDoNotWidenTheBox) {
    const auto at = [](double i, double j, double k) { return 0.1 * glm::dvec3(i, j, k); };
    const UnstructuredGrid grid = bricks({4, 3, 3}, Cut::Hexahedra, at);
    UnstructuredGrid more = grid;
    for (const double far : {-5.0, 1e7, 1e20}) more.points.push_back(glm::dvec3(far));
    ASSERT_EQ(flawOf(more), "");
    const Mesh points = tests::atPoints(grid), withMore = tests::atPoints(more);
    EXPECT_EQ(withMore.lo(), points.lo());
    EXPECT_EQ(withMore.hi(), points.hi());
    for (std::uint64_t i = 0; i < points.count(); ++i) {
        EXPECT_EQ(withMore.position(i), points.position(i));
        EXPECT_EQ(tests::volume(withMore, i), tests::volume(points, i));
    }
    EXPECT_EQ(withMore.about().apart, 3u);
    const Mesh cells = tests::atCells(grid), cellsWithMore = tests::atCells(more);
    EXPECT_EQ(cellsWithMore.lo(), cells.lo());
    EXPECT_EQ(cellsWithMore.hi(), cells.hi());
    EXPECT_EQ(cellsWithMore.cornersBox().hi, cells.cornersBox().hi);
    for (std::uint64_t i = 0; i < cells.count(); ++i) {
        EXPECT_EQ(cellsWithMore.position(i), cells.position(i));
        EXPECT_EQ(tests::volume(cellsWithMore, i), tests::volume(cells, i));
    }
}

// Two rectangles of 3 x 2 each: as thick as the root of 6.
TEST(Unstructured, SurfacesAndLinesAreAsThickAsTheyAreWide) {
    UnstructuredGrid surface;
    surface.points = {{0, 0, 0}, {3, 0, 0}, {0, 0, 2}, {3, 0, 2}, {0, 0, 4}, {3, 0, 4}};
    addCell(surface, 9, {0, 1, 3, 2});
    addCell(surface, 8, {2, 3, 4, 5});  // a pixel, whose corners stand in rows
    const double thick = std::sqrt(6.0);
    for (const Mesh& mesh : {tests::atCells(surface), tests::atPoints(surface)})
        EXPECT_NEAR(volume(mesh), 12 * thick, 1e-5);
    const auto cell = tests::atCells(surface).cell(0);
    EXPECT_NEAR(cell.diagonal.x, 3, 1e-6);
    EXPECT_NEAR(cell.diagonal.y, thick, 1e-6);
    EXPECT_NEAR(cell.diagonal.z, 2, 1e-6);
    UnstructuredGrid lines;
    lines.points = {{0, 0, 0}, {2, 0, 0}, {2, 4, 0}};
    addCell(lines, 3, {0, 1});
    addCell(lines, 4, {1, 2});
    for (const Mesh& mesh : {tests::atCells(lines), tests::atPoints(lines)})
        EXPECT_NEAR(volume(mesh), 6 * 3 * 3, 1e-5);
}

// One a cell, or all of them of one.
TEST(Unstructured, PointsAloneAreScattered) {
    UnstructuredGrid points;
    points.points = {{0, 0, 0}, {2, 0, 0}, {2, 4, 0}, {0, 4, 1}};
    UnstructuredGrid together = points;
    for (std::uint32_t i = 0; i < 4; ++i) addCell(points, 1, {i});
    addCell(together, 2, {0, 1, 2, 3});
    const Mesh expected = meshOfScattered(points.points);
    EXPECT_EQ(tests::atPoints(points), expected);
    EXPECT_EQ(tests::atCells(points), expected);
    EXPECT_EQ(tests::atPoints(together), expected);
}

TEST(Unstructured, CurvedCellsAreTold) {
    UnstructuredGrid grid;
    grid.points = {{0, 0, 0},   {1, 0, 0},  {0, 1, 0},  {0, 0, 1},   {.5, 0, 0},
                   {.5, .5, 0}, {0, .5, 0}, {0, 0, .5}, {.5, 0, .5}, {0, .5, .5}};
    addCell(grid, 24, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    EXPECT_NEAR(volume(tests::atCells(grid)), 1.0 / 6, 1e-7);
    EXPECT_NEAR(volume(tests::atPoints(grid)), 1.0 / 6, 1e-7);
    ASSERT_EQ(notesOf(grid).size(), 1u);
    EXPECT_TRUE(notesOf(bentBricks(Cut::Wedges)).empty());
}

TEST(Unstructured, WhatNamesNothingIsTold) {
    const UnstructuredGrid good = bentBricks(Cut::Polyhedra);
    const auto flawWith = [&](const auto& change) {
        UnstructuredGrid grid = good;
        change(grid);
        return flawOf(grid);
    };
    EXPECT_EQ(flawWith([](auto& g) { g.corners[9] = 120; }), "cell 1 has point 120 of 120");
    EXPECT_EQ(flawWith([](auto& g) { g.ends[3] = 7; }), "cell 3 ends at 7 of 480 entries");
    EXPECT_EQ(flawWith([](auto& g) { g.ends.back() = 481; }), "cell 59 ends at 481 of 480 entries");
    EXPECT_NE(flawWith([](auto& g) { g.ends.pop_back(); }), "");
    EXPECT_EQ(flawWith([](auto& g) { g.types[0] = 16; }),
              "cell 0 of type 16 has 8 points, fewer than 12");
    EXPECT_EQ(flawWith([](auto& g) { g.faceEnds.clear(); }),
              "cell 0 is a polyhedron without faces");
    EXPECT_EQ(flawWith([](auto& g) { g.faceEnds[2] = 9999; }),
              "faces: cell 2 ends at 9999 of 1860 entries");
    EXPECT_EQ(flawWith([](auto& g) { g.faces[0] = 7; }), "the faces of cell 0 end early");
    EXPECT_EQ(flawWith([](auto& g) { g.faces[1] = 4000000000u; }), "the faces of cell 0 end early");
    EXPECT_EQ(flawWith([](auto& g) { g.faces[2] = 500; }), "a face of cell 0 has point 500 of 120");
}

TEST(Unstructured, OfManyFlawsTheFirstIsTold) {
    const UnstructuredGrid good =
        bricks({40, 40, 40}, Cut::Hexahedra,
               [](double i, double j, double k) { return glm::dvec3(i, j, k); });
    for (const std::size_t first : {0u, 777u, 29000u, 59000u}) {
        UnstructuredGrid grid = good;
        for (std::size_t cell = first; cell < 59319; cell += 100)
            grid.corners[8 * cell + 5] = 64000;
        EXPECT_EQ(flawOf(grid), fmt::format("cell {} has point 64000 of 64000", first));
        grid.ends[first + 50] = 1;
        EXPECT_EQ(flawOf(grid), fmt::format("cell {} ends at 1 of 474552 entries", first + 50));
    }
}

// Corners in any order: the moments of what then crosses itself are no solid's.
TEST(Unstructured, CellsThatCrossThemselvesAreNoLargerThanTheirCornersAreApart) {
    constexpr double kAway = 0.1, kSide = 1 + 2 * kAway;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> away(-kAway, kAway);
    int measured = 0;
    for (int round = 0; round < 20'000; ++round) {
        UnstructuredGrid grid =
            bricks({2, 2, 2}, Cut::Hexahedra, [&](double i, double j, double k) {
                return glm::dvec3(i + away(random), j + away(random), k + away(random));
            });
        std::shuffle(grid.corners.begin(), grid.corners.end(), random);
        for (const auto& meshOf : {tests::atCells, tests::atPoints}) {
            try {
                const glm::dvec3 widest = meshOf(grid).widest();
                ASSERT_LT(std::max({widest.x, widest.y, widest.z}), 2 * kSide) << round;
                ++measured;
            } catch (const std::invalid_argument&) {  // of no volume
            }
        }
    }
    EXPECT_GT(measured, 20'000);
}

// Any number anywhere: what has no flaw is measured, and nothing is read that is not there.
TEST(Unstructured, WhateverHasNoFlawIsMeasured) {
    std::mt19937 random(11);
    int measured = 0;
    for (int round = 0; round < 3000; ++round) {
        UnstructuredGrid grid = bricks({2, 2, 3}, kCuts[random() % kCuts.size()], bent);
        const auto change = [&](auto& list) {
            if (list.empty()) return;
            using Number = std::remove_reference_t<decltype(list[0])>;
            list[random() % list.size()] = static_cast<Number>(random() % 14);
        };
        for (auto n = random() % 3; n > 0; --n) {
            change(grid.types), change(grid.corners);
            if (random() % 2) change(grid.ends), change(grid.faces), change(grid.faceEnds);
        }
        if (!flawOf(grid).empty()) continue;
        if (const auto solids = SolidCells::of(grid, 10))  // two points have no values
            for (std::uint64_t cell = 0; cell < solids->count(); ++cell)
                solids->forEachTet(cell, [&](const auto& tet) {
                    for (const std::uint32_t point : tet) ASSERT_LT(point, 10u);
                });
        for (const auto& meshOf : {tests::atCells, tests::atPoints}) {
            try {
                EXPECT_TRUE(std::isfinite(volume(meshOf(grid))));
                ++measured;
            } catch (const std::invalid_argument&) {
            }
        }
    }
    EXPECT_GT(measured, 1000);
}

}  // namespace
}  // namespace timeseries
