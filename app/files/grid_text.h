// What kind of grid the points of a field lie on, and of which cells it is: what `info` tells.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "timeseries/grid/grid.h"
#include "timeseries/grid/step_grids.h"

namespace app {

// "uniform", "rectilinear, rotated", "curvilinear", "unstructured", "adaptive", "scattered" ...
std::string gridKind(const timeseries::Grid& grid);
// "curvilinear, 9 x 8 x 7 = 504 points", "unstructured, 5,200 points, one a cell: 5,000 hexahedra,
// 200 wedges".
std::string gridText(const timeseries::Grid& grid);
// "longitudes -44.6 to 65, latitudes 22 to 72.6 degrees", where they are told beside other axes;
// else "".
std::string earthText(const timeseries::Grid& grid);
// What the grids of other steps are to it: "of the first step; others have their own, of 8 to 20
// points"; "" where all have the same.
std::string stepGridsText(const timeseries::StepGrids& grids);
// The same as members: steps ("one", "moved" or "own"), and of own ones, where that is known,
// leastPoints and mostPoints.
nlohmann::ordered_json stepGridsJson(const timeseries::StepGrids& grids);
// What gridText() and earthText() tell as members: kind, points, of cells at (cells or corners),
// cells, levels; and earth: longitudes and latitudes, the least and the greatest of each.
nlohmann::ordered_json gridJson(const timeseries::Grid& grid);

}  // namespace app
