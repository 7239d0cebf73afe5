// Error against time, as a picture.
#pragma once

#include <span>
#include <string>

#include "app/measure/measurement.h"

namespace app {

// An SVG: the relative L2 of optical depth by the time of a frame, both logarithmic; the points'
// subsets joined. A mode whose mass is off is hollow. `title`: any text.
std::string tradePlot(std::span<const Measured> modes, const std::string& title);

}  // namespace app
