// Axes of longitude and latitude, and of levels of no measure, upwards.
#pragma once

#include <array>
#include <memory>

#include "tests/support/measured_axis.h"
#include "timeseries/grid/grid.h"

namespace tests {

inline timeseries::Axis east(double first, double last, int count) {
    return measuredAxis("lon", "degrees_east", first, last, count);
}
inline timeseries::Axis north(double first, double last, int count) {
    return measuredAxis("lat", "degrees_north", first, last, count);
}
inline timeseries::Axis levels(int count) {
    return measuredAxis("level", "1", 0, count - 1, count);
}

inline std::shared_ptr<const timeseries::Grid> gridOf(const timeseries::Axis& x,
                                                      const timeseries::Axis& y,
                                                      const timeseries::Axis& z) {
    return std::make_shared<const timeseries::Grid>(std::array{x, y, z});
}

}  // namespace tests
