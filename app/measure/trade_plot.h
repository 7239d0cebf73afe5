// Error against time, as a picture.
#pragma once

#include <span>
#include <string>

#include "app/measure/measurement.h"
#include "app/measure/plot.h"

namespace app {

// The relative L2 of optical depth by the time of a frame, both logarithmic; the points' subsets
// joined. A mode whose mass is off is hollow. `title`: any text, cut where
// the plot ends.
Plot tradePlot(std::span<const Measured> modes, const std::string& title);

}  // namespace app
