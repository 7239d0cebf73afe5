// What kind of grid the points of a field lie on, and of which cells it is: what `info` tells.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "timeseries/grid/grid.h"

namespace app {

// "uniform", "rectilinear, rotated", "curvilinear", "unstructured", "adaptive", "scattered" ...
std::string gridKind(const timeseries::Grid& grid);
// "curvilinear, 9 x 8 x 7 = 504 points", "unstructured, 5,200 points, one a cell: 5,000 hexahedra,
// 200 wedges".
std::string gridText(const timeseries::Grid& grid);
// The same as members: kind, points, and of cells at (cells or corners), cells, levels.
nlohmann::ordered_json gridJson(const timeseries::Grid& grid);

}  // namespace app
