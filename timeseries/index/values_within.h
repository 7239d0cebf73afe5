// Which of a field's values lie in an interval, many at once.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "timeseries/index/ordered_key.h"
#include "timeseries/index/range_set.h"

namespace timeseries {

// Of so many values at once.
inline constexpr std::size_t kWithinAtOnce = 2048;

// Places in a span of values; behind the last found there is room for what a vector holds.
template <typename T>
using PlacesWithin = std::array<OrderedKey<T>, kWithinAtOnce + 64>;

// The places of those with lo <= value <= hi, ascending; returns how many there are. Of values of
// four or eight bytes. REQUIRES: at most kWithinAtOnce values.
template <typename T>
std::size_t valuesWithin(std::span<const T> values, const Interval<T>& interval,
                         PlacesWithin<T>& places);

}  // namespace timeseries
