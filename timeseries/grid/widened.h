// Cells whose lines close about an axis, as those of longitude do about a pole. Their splats would
// be needles that all reach across it, and add up to twenty times what they should there. Such a
// cell is drawn wider along its line, by a power of two, and keeps its volume: less than a tenth
// rms is left within three cells of the axis.
#pragma once

#include <algorithm>
#include <cmath>

namespace timeseries {

constexpr unsigned kMostWidened = 31;  // a factor of 2^31

// By how many factors of two: of a cell so long along its line and so wide across it, `away` from
// the axis.
inline unsigned wideningAbout(double side, double across, double away) {
    constexpr double kNeedle = 0.5, kAtAxis = 1.5;
    const double ratio = away / across;
    const double wanted = (kAtAxis - ratio * ratio) * across;
    if (!(side > 0 && side < kNeedle * across && wanted > side)) return 0;
    return std::min(static_cast<unsigned>(std::lround(std::log2(wanted / side))), kMostWidened);
}

}  // namespace timeseries
