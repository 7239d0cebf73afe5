// The two binary searches behind every selection.
#pragma once

#include <algorithm>
#include <functional>
#include <span>

#include "timeseries/range_set.h"
#include "timeseries/sorted_step.h"

namespace timeseries {

// The points of `ascending` with lo <= value <= hi: at most 2 (floor(log2 n) + 1) calls of `less`.
template <typename T, typename Less = std::less<T>>
Run findRun(std::span<const T> ascending, const Interval<T>& interval, Less less = {}) {
    const auto first = std::lower_bound(ascending.begin(), ascending.end(), interval.lo, less);
    const auto last = std::upper_bound(first, ascending.end(), interval.hi, less);
    return {static_cast<std::uint64_t>(first - ascending.begin()),
            static_cast<std::uint64_t>(last - first)};
}

}  // namespace timeseries
