// Integers that order as values do, so that one sort and one search serve every type.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <type_traits>

namespace timeseries {

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

template <typename T>
using OrderedKey = decltype(orderedKey(T{}));

}  // namespace timeseries
