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
// With a name each.
#define ISOCHRON_WIDE_TYPES(use)                                                                  \
    use(std::uint32_t, U32) use(std::int32_t, I32) use(std::uint64_t, U64) use(std::int64_t, I64) \
        use(float, F32) use(double, F64)
#define ISOCHRON_WITHIN(T, name) \
    template <>                  \
    std::size_t valuesWithin<T>(std::span<const T>, const Interval<T>&, PlacesWithin<T>&);
ISOCHRON_WIDE_TYPES(ISOCHRON_WITHIN)
#undef ISOCHRON_WITHIN

}  // namespace timeseries
