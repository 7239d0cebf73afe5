// A grid of some of another's cells.
#pragma once

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

}  // namespace timeseries
