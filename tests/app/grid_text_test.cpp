// What `info` tells of a grid and its cells.
#include "app/files/grid_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/meshes.h"
#include "tests/support/scenes.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/scattered.h"

namespace app {
namespace {

using tests::addCell;
using timeseries::UnstructuredGrid;

glm::dvec3 atIndices(double i, double j, double k) { return {i, j, k}; }

// 3 x 2 x 2 hexahedra, a cut one's two wedges, and what takes no space beside them.
UnstructuredGrid severalKinds() {
    UnstructuredGrid grid = tests::bricks({4, 3, 3}, tests::Cut::Hexahedra, atIndices);
    addCell(grid, 13, {0, 4, 1, 12, 16, 13});
    addCell(grid, 26, {0, 4, 1, 12, 16, 13, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    addCell(grid, 32, {0, 4, 1, 12, 16, 13, 0, 0, 0, 0, 0, 0});  // curved wedges, another kind
    addCell(grid, 3, {0, 1});
    addCell(grid, 200, {0});
    return grid;
}

TEST(GridText, CellsAreCountedByKindTheMostFirst) {
    const auto cells = tests::gridOf(tests::atCells(severalKinds()));
    const std::string kinds = "12 hexahedra, 2 curved wedges, 1 line, 1 wedge, 1 cell of type 200";
    EXPECT_EQ(gridText(*cells), "unstructured, 17 points, one a cell: " + kinds);
    EXPECT_EQ(gridText(*tests::gridOf(tests::atPoints(severalKinds()))),
              "unstructured, 36 points, corners of cells: " + kinds);
    const auto json = gridJson(*cells);
    EXPECT_EQ(json["kind"], "unstructured");
    EXPECT_EQ(json["at"], "cells");
    ASSERT_EQ(json["cells"].size(), 5u);
    EXPECT_EQ(json["cells"][1].dump(), R"({"kind":"curved wedge","count":2})");
}

TEST(GridText, ManyKindsAreNotAllTold) {
    UnstructuredGrid grid = tests::bricks({2, 2, 2}, tests::Cut::Voxels, atIndices);
    for (std::uint8_t type = 200; type < 220; ++type) addCell(grid, type, {0});
    const std::string text = gridText(*tests::gridOf(tests::atCells(grid)));
    EXPECT_TRUE(text.ends_with("1 cell of type 206 and 13 other kinds")) << text;
}

// 4000 x 11 tetrahedra: more than one thread counts.
TEST(GridText, MillionsHaveCommas) {
    const auto grid = tests::bricks({41, 41, 11}, tests::Cut::Tetrahedra, atIndices);
    EXPECT_EQ(gridText(*tests::gridOf(tests::atCells(grid))),
              "unstructured, 80,000 points, one a cell: 80,000 tetrahedra");
}

TEST(GridText, LevelsLieAboveASurface) {
    UnstructuredGrid grid = tests::bricks({3, 3, 1}, tests::Cut::Hexahedra, atIndices);
    addCell(grid, 5, {0, 1, 3});
    addCell(grid, 5, {1, 4, 3});
    const timeseries::UnstructuredShapes shapes(grid);
    EXPECT_EQ(gridText(*tests::gridOf(meshOfCells(grid, shapes, {0, 10, 30}))),
              "unstructured, 6 points, one a cell on each of 3 levels: 2 triangles");
}

TEST(GridText, LeavesOfAnAdaptiveMeshAreTold) {
    UnstructuredGrid grid = tests::bricks({3, 3, 3}, tests::Cut::Voxels, atIndices);
    grid.levels = 3;
    EXPECT_EQ(gridText(*tests::gridOf(tests::atCells(grid))),
              "adaptive, 8 points, leaves of 3 levels: 8 voxels");
    const auto points = tests::gridOf(tests::atPoints(grid));
    EXPECT_EQ(gridText(*points), "adaptive, 27 points, corners of leaves of 3 levels: 8 voxels");
    EXPECT_EQ(gridJson(*points)["levels"], 3);
}

TEST(GridText, PointsAloneAreScattered) {
    const std::vector<glm::dvec3> at{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(gridText(*tests::gridOf(timeseries::meshOfScattered(at))), "scattered, 3 points");
    EXPECT_EQ(gridText(*tests::gridOf(timeseries::meshOfVolumes(at, {1, 2, 3}))),
              "scattered, 3 points, each as large as the file says");
    EXPECT_EQ(gridJson(*tests::gridOf(timeseries::meshOfScattered(at))).dump(),
              R"({"kind":"scattered","points":3})");
}

TEST(GridText, AlongIndicesThereAreSizes) {
    EXPECT_EQ(gridText(*tests::twisted()), "curvilinear, 9 x 8 x 7 = 504 points");
}

TEST(GridText, PlacesOnTheEarthAreToldByTheirEnds) {
    const auto grid = tests::cube(2);
    EXPECT_EQ(earthText(*grid), "");
    EXPECT_FALSE(gridJson(*grid).contains("earth"));
    const timeseries::Grid there = grid->withEarth(std::make_shared<const timeseries::EarthPlaces>(
        std::vector<glm::dvec2>{{10, 50}, {-20.25, 40.5}, {30, 60}, {1e20, 0}}));
    EXPECT_EQ(earthText(there), "longitudes -20.25 to 30, latitudes 40.5 to 60 degrees");
    EXPECT_EQ(gridJson(there)["earth"].dump(),
              R"({"longitudes":[-20.25,30.0],"latitudes":[40.5,60.0]})");
}

}  // namespace
}  // namespace app
