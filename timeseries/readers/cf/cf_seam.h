// Longitudes that begin anew, as 179 and then -180 do, laid out as if they went on.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace timeseries {

// Along an axis, in degrees: where they begin anew once and lead less than once around.
void goOnAcrossTheSeam(std::vector<double>& longitudes);
// Of places along two indices, i fastest, the first coordinates, which come round after `turn`:
// where all neighbours can be within half a turn of each other, as they cannot about a pole, and
// together lead little more than once around.
void goOnAcrossTheSeam(std::vector<glm::dvec3>& places, const std::array<std::size_t, 3>& size,
                       double turn);
// Of places anywhere, in degrees: where they leave out a tenth of a turn, and the seam parts them.
// Those at a pole, where every longitude is the same, tell nothing.
void goOnAcrossTheSeam(std::vector<double>& longitudes, const std::vector<double>& latitudes);

}  // namespace timeseries
