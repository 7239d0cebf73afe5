// An axis as files have them: named, measured, evenly spaced.
#pragma once

#include <string>
#include <utility>

#include "timeseries/grid/grid.h"

namespace tests {

inline timeseries::Axis measuredAxis(std::string name, std::string unit, double first, double last,
                                     int count, bool down = false) {
    timeseries::Axis a{
        .name = std::move(name), .units = std::move(unit), .coordinates = {}, .down = down};
    for (int i = 0; i < count; ++i)
        a.coordinates.push_back(count == 1 ? first : first + (last - first) * i / (count - 1));
    return a;
}

}  // namespace tests
