// What is wrong with a clip box for the data that it is to cut.
#pragma once

#include <string>

#include "app/choices/explorer.h"
#include "timeseries/grid/grid.h"

namespace app {

// One sentence where no point of the grid lies in the box; else "".
std::string clipFlaw(const ClipBox& clip, const timeseries::Grid& grid);

}  // namespace app
