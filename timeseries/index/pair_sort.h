// Points by value, ties by grid index: packed for the sort and unpacked again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include "timeseries/index/ordered_key.h"
#include "timeseries/index/value_sort.h"

namespace timeseries {

// A point as it is sorted: by value, then by grid index.
template <typename T>
using PackedPoint = std::conditional_t<sizeof(T) <= 4, std::uint64_t, WideKey>;

template <typename T>
PackedPoint<T> packPoint(OrderedKey<T> key, std::uint32_t gridIndex) {
    if constexpr (sizeof(T) <= 4)
        return std::uint64_t{key} << 32 | gridIndex;
    else
        return {gridIndex, key};
}
template <typename T>
OrderedKey<T> keyOf(const PackedPoint<T>& point) {
    if constexpr (sizeof(T) <= 4)
        return static_cast<OrderedKey<T>>(point >> 32);
    else
        return point.key;
}
template <typename T>
std::uint32_t gridIndexOf(const PackedPoint<T>& point) {
    if constexpr (sizeof(T) <= 4)
        return static_cast<std::uint32_t>(point);
    else
        return static_cast<std::uint32_t>(point.index);
}

// The other way round, into columns of the same size.
template <typename T>
void unpackPoints(std::span<const PackedPoint<T>> points, std::span<T> values,
                  std::span<std::uint32_t> gridIndex) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        values[i] = valueOfKey<T>(keyOf<T>(points[i]));
        gridIndex[i] = gridIndexOf<T>(points[i]);
    }
}

// `keys` are the points' in the order of gridIndex as it is; values get what they stand for, and
// both come out in order. `room`: for so many, which become anything. REQUIRES: all of one size.
template <typename T>
void sortPairs(std::span<const OrderedKey<T>> keys, std::span<std::uint32_t> gridIndex,
               std::span<T> values, std::span<PackedPoint<T>> room) {
    const auto points = room.first(keys.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = packPoint<T>(keys[i], gridIndex[i]);
    sortPacked(points);
    unpackPoints<T>(points, values, gridIndex);
}

}  // namespace timeseries
