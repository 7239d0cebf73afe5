// What keeps data from being drawn on a globe.
#pragma once

#include <string>

#include "timeseries/grid/grid.h"

namespace app {

// One sentence where the grid's points have no place on a globe; else "".
std::string globeFlaw(const timeseries::Grid& grid);

}  // namespace app
