// A belt about a sphere of 12 x 5 cells of 30 by 24 degrees, which cross the seam of longitudes.
#pragma once

#include <cmath>

namespace tests {

inline constexpr int kAround = 12, kUp = 5, kCells = kAround * kUp, kNodes = kAround * (kUp + 1);
inline constexpr double kWide = 30, kHigh = 24;

inline double lonOf(double i) { return -180 + kWide * i; }
inline double latOf(double j) { return -60 + kHigh * j; }
inline double wrapped(double lon) { return lon - 360 * std::round(lon / 360); }

}  // namespace tests
