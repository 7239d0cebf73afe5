// What keeps data from being drawn on a globe.
#pragma once

#include <string>

#include "timeseries/grid/grid.h"

namespace app {

// One sentence where the grid's points have no place on a globe; else "".
std::string globeFlaw(const timeseries::Grid& grid);
// Of a grid without such a flaw, which its points alone tell.
inline constexpr const char* kNoVolumeOnGlobe = "none of its cells has a volume on a globe";

}  // namespace app
