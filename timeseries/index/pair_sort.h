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

// `keys` are the points' in the order of gridIndex as it is; values get what they stand for, and
// both come out in order. REQUIRES: all of one size.
template <typename T>
void sortPairs(std::span<const OrderedKey<T>> keys, std::span<std::uint32_t> gridIndex,
               std::span<T> values) {
    using Packed = std::conditional_t<sizeof(T) <= 4, std::uint64_t, WideKey>;
    const std::size_t n = keys.size();
    const auto packed = std::make_unique_for_overwrite<Packed[]>(n);
    for (std::size_t i = 0; i < n; ++i) {
        if constexpr (sizeof(T) <= 4) {
            packed[i] = std::uint64_t{keys[i]} << 32 | gridIndex[i];
        } else {
            packed[i] = {gridIndex[i], keys[i]};
        }
    }
    sortPacked(std::span(packed.get(), n));
    for (std::size_t i = 0; i < n; ++i) {
        if constexpr (sizeof(T) <= 4) {
            values[i] = valueOfKey<T>(static_cast<OrderedKey<T>>(packed[i] >> 32));
            gridIndex[i] = static_cast<std::uint32_t>(packed[i]);
        } else {
            values[i] = valueOfKey<T>(packed[i].key);
            gridIndex[i] = static_cast<std::uint32_t>(packed[i].index);
        }
    }
}

}  // namespace timeseries
