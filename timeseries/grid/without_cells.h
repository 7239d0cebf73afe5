// A grid of some of another's cells.
#pragma once

#include <vector>

#include "timeseries/grid/unstructured.h"

namespace timeseries {

// All of its points, and its cells but those that are left out. REQUIRES: no flaw; as many as
// cells.
UnstructuredGrid withoutCells(const UnstructuredGrid& grid, const std::vector<bool>& leftOut);

}  // namespace timeseries
