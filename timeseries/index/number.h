// A number exactly as a user, a file or a field states it: no integer passes through a double.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>

namespace timeseries {

using Number = std::variant<double, std::int64_t, std::uint64_t>;

// Of a value of any field, exactly.
template <typename T>
Number numberOf(T value) {
    if constexpr (std::is_floating_point_v<T>) {
        return static_cast<double>(value);
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        return value;
    } else {
        return static_cast<std::int64_t>(value);
    }
}

// The mathematical order of the two numbers, exact across types (2^60 + 1 as int64 is greater than
// 2^60 as double). Unordered when either is NaN. -0 equals +0.
std::partial_ordering compare(const Number& a, const Number& b);

// The nearest double.
double toDouble(const Number& number);

// Shortest text that reads back as the same number (600.0 is "600"); "inf", "-inf", "nan".
std::string toText(const Number& number);

}  // namespace timeseries
