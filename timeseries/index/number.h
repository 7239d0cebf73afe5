// A number exactly as a user, a file or a field states it: no integer passes through a double.
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
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

// The nearest T as IEEE 754 rounds: the largest one up to half a step beyond it (15 digits of it
// are more), then infinity.
template <typename T>
T nearestFloat(double value) {
    using Limits = std::numeric_limits<T>;
    constexpr auto greatest = static_cast<double>(Limits::max());
    if constexpr (std::is_same_v<T, double>) return value;
    if (!(std::abs(value) > greatest)) return static_cast<T>(value);
    const double halfStep = std::ldexp(1.0, Limits::max_exponent - Limits::digits - 1);
    const T most = std::abs(value) - greatest < halfStep ? Limits::max() : Limits::infinity();
    return std::copysign(most, static_cast<T>(std::signbit(value) ? -1 : 1));
}

// The mathematical order of the two numbers, exact across types (2^60 + 1 as int64 is greater than
// 2^60 as double). Unordered when either is NaN. -0 equals +0.
std::partial_ordering compare(const Number& a, const Number& b);

// The nearest double.
double toDouble(const Number& number);

// Shortest text that reads back as the same number (600.0 is "600"); "inf", "-inf", "nan".
std::string toText(const Number& number);

}  // namespace timeseries
