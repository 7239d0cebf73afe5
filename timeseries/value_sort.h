// Sorting (value, grid index) pairs by value, ties by index, as fast as each type allows:
// counting sort for 8 and 16 bits, one vectorised sort of packed keys for 32 and 64 bits.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace timeseries {

template <typename T>
struct SortedPairs {
    std::vector<T> values;             // ascending
    std::vector<std::uint32_t> index;  // grid index of each value
};

// Both ascend. Highway's vectorised quicksort (Wassenberg et al. 2022), compiled once.
struct WideKey {  // orders by key, then index
    std::uint64_t index, key;
};
void sortPacked(std::span<std::uint64_t> keys);
void sortPacked(std::span<WideKey> keys);

// The unsigned integer of T's size that orders as T does; -0 has the key of +0.
template <std::integral T>
auto orderedKey(T value) {
    using U = std::make_unsigned_t<T>;
    constexpr U kFlip = std::signed_integral<T> ? U{1} << (8 * sizeof(T) - 1) : U{0};
    return static_cast<U>(static_cast<U>(value) ^ kFlip);
}
template <std::floating_point T>
auto orderedKey(T value) {
    using U = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    constexpr U kSign = U{1} << (8 * sizeof(T) - 1);
    const U bits = std::bit_cast<U>(value + T{0});  // -0 + 0 is +0
    return bits & kSign ? static_cast<U>(~bits) : bits | kSign;
}
template <typename T, typename U>
T valueOfKey(U key) {
    constexpr U kSign = U{1} << (8 * sizeof(U) - 1);
    if constexpr (std::floating_point<T>) {
        return std::bit_cast<T>(key & kSign ? static_cast<U>(key & ~kSign) : static_cast<U>(~key));
    } else {
        return static_cast<T>(std::signed_integral<T> ? key ^ kSign : key);
    }
}

namespace detail {

template <typename T, typename Keep>
SortedPairs<T> countingSort(std::span<const T> field, std::size_t kept, const Keep& keep) {
    constexpr std::size_t kKeys = std::size_t{1} << (8 * sizeof(T));
    std::vector<std::size_t> next(kKeys + 1);
    for (std::size_t i = 0; i < field.size(); ++i)
        if (keep(i)) ++next[orderedKey(field[i]) + 1u];
    SortedPairs<T> out;
    out.values.reserve(kept);
    for (std::size_t key = 0; key < kKeys; ++key) {
        out.values.insert(out.values.end(), next[key + 1],
                          valueOfKey<T>(static_cast<std::make_unsigned_t<T>>(key)));
        next[key + 1] += next[key];
    }
    out.index.resize(kept);
    for (std::size_t i = 0; i < field.size(); ++i)
        if (keep(i)) out.index[next[orderedKey(field[i])]++] = static_cast<std::uint32_t>(i);
    return out;
}

template <typename T, typename Keep>
SortedPairs<T> packedSort(std::span<const T> field, std::size_t kept, const Keep& keep) {
    using Key = std::conditional_t<sizeof(T) == 4, std::uint64_t, WideKey>;
    const auto keys = std::make_unique_for_overwrite<Key[]>(kept);
    std::size_t n = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
        if (!keep(i)) continue;
        if constexpr (sizeof(T) == 4) {
            keys[n++] = std::uint64_t{orderedKey(field[i])} << 32 | i;
        } else {
            keys[n++] = {i, orderedKey(field[i])};
        }
    }
    sortPacked(std::span(keys.get(), kept));
    SortedPairs<T> out{std::vector<T>(kept), std::vector<std::uint32_t>(kept)};
    for (std::size_t i = 0; i < kept; ++i) {
        if constexpr (sizeof(T) == 4) {
            out.values[i] = valueOfKey<T>(static_cast<std::uint32_t>(keys[i] >> 32));
            out.index[i] = static_cast<std::uint32_t>(keys[i]);
        } else {
            out.values[i] = valueOfKey<T>(keys[i].key);
            out.index[i] = static_cast<std::uint32_t>(keys[i].index);
        }
    }
    return out;
}

}  // namespace detail

// Sorts the points of `field` for which keep(i) holds. REQUIRES: field.size() <= 2^32; no kept
// value is NaN; keep holds for exactly `kept` points.
template <typename T, typename Keep>
SortedPairs<T> sortByValue(std::span<const T> field, std::size_t kept, const Keep& keep) {
    if constexpr (sizeof(T) <= 2) {
        return detail::countingSort(field, kept, keep);
    } else {
        return detail::packedSort(field, kept, keep);
    }
}

}  // namespace timeseries
