// Which mode to choose of those that were measured: the most accurate that a time allows, and the
// soonest that an error allows.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "app/measure/measurement.h"

namespace app {

struct BestMode {
    double limit = 0;                 // seconds a frame, or an error
    std::optional<std::size_t> mode;  // its place among the measured; none keeps to the limit
};
// At 1, 2, 5, 10 ... of what the modes span. A mode whose mass is off is no choice, and none that
// mixes colours where others do not; light adds to the time and takes nothing from the error of
// depth.
std::vector<BestMode> mostAccurateWithin(std::span<const Measured> modes);  // limits of the frame
std::vector<BestMode> soonestWithin(std::span<const Measured> modes);  // limits of the depth error

}  // namespace app
