// Which of a field's values lie in an interval, many at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "timeseries/index/ordered_key.h"
#include "timeseries/index/range_set.h"

namespace timeseries {

// Of so many values at once.
inline constexpr std::size_t kWithinAtOnce = 2048;

// Places in a span of values.
template <typename T>
using PlacesWithin = std::array<OrderedKey<T>, kWithinAtOnce>;

// The places of those with lo <= value <= hi, ascending; returns how many there are. Of values of
// four or eight bytes. REQUIRES: at most kWithinAtOnce values.
template <typename T>
std::size_t valuesWithin(std::span<const T> values, const Interval<T>& interval,
                         PlacesWithin<T>& places);
#define ISOCHRON_WITHIN(T) \
    template <>            \
    std::size_t valuesWithin<T>(std::span<const T>, const Interval<T>&, PlacesWithin<T>&);
ISOCHRON_WITHIN(std::uint32_t)
ISOCHRON_WITHIN(std::int32_t)
ISOCHRON_WITHIN(std::uint64_t)
ISOCHRON_WITHIN(std::int64_t)
ISOCHRON_WITHIN(float)
ISOCHRON_WITHIN(double)
#undef ISOCHRON_WITHIN

}  // namespace timeseries
