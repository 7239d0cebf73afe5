// What a step knows of all its points, from counting them.
#pragma once

#include <limits>

#include "timeseries/index/number.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/index/value_partition.h"

namespace timeseries {

// Of so many values of a field, of which the partition found what is valid.
template <typename T>
StepStatistics statisticsOf(std::size_t values, const Partition<T>& points) {
    StepStatistics s;
    s.points = points.valid;
    s.missing = values - s.points;
    s.min = s.max = s.finiteMin = s.finiteMax = std::numeric_limits<double>::quiet_NaN();
    if (s.points > 0) {
        s.min = numberOf(points.leastValid);
        s.max = numberOf(points.greatestValid);
    }
    if (points.finite) {
        s.finiteMin = numberOf(points.finite->first);
        s.finiteMax = numberOf(points.finite->second);
    }
    return s;
}

}  // namespace timeseries
