// What is left of a grid without some of its cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "timeseries/grid/unstructured.h"

namespace timeseries {

// All of its points, and its cells but those that are left out. REQUIRES: no flaw; as many as
// cells.
UnstructuredGrid withoutCells(const UnstructuredGrid& grid, const std::vector<bool>& leftOut);
// meshOfPoints() of that: what a ghost takes up is another cell's, or nobody's. REQUIRES: as many
// as cells, or none; the shapes of the grid.
Mesh meshOfPointsWithout(const std::vector<bool>& ghosts, const UnstructuredGrid& grid,
                         const UnstructuredShapes& shapes);
// Of points along indices, so many, those that are of ghosts alone; empty where there are none.
// REQUIRES: as many as cells between them, x fastest, or none; an axis of one point is one thick.
std::vector<bool> pointsOfGhosts(std::vector<bool> ghosts,
                                 const std::array<std::uint64_t, 3>& points);
// Of a grid's points those that are corners of ghosts and of no other cell; empty where there are
// none. REQUIRES: no flaw; as many as cells, or none.
std::vector<bool> pointsOfGhosts(const std::vector<bool>& ghosts, const UnstructuredGrid& grid);
// Those too.
void leaveOut(const std::vector<bool>& more, std::vector<bool>& missing);

}  // namespace timeseries
