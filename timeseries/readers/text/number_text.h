// Numbers as texts of values state them.
#pragma once

#include <charconv>
#include <concepts>
#include <cstdlib>
#include <optional>
#include <string>

namespace timeseries {

// All of the word as a number of the type, to its nearest; a plus may stand before it. What is
// beyond a floating-point type's range is infinite or zero, as in C; nothing where it is no number,
// or an integer that the type does not hold.
template <typename T>
std::optional<T> numberOfText(const std::string& word) {
    const bool isPositive = word.size() > 1 && word[0] == '+' && word[1] != '-';
    const char* const begin = word.c_str() + (isPositive ? 1 : 0);
    const char* const end = word.c_str() + word.size();
    T number{};
    const auto [stop, error] = std::from_chars(begin, end, number);
    if (stop != end) return std::nullopt;
    if constexpr (std::floating_point<T>)
        if (error == std::errc::result_out_of_range)
            return std::same_as<T, float> ? static_cast<T>(std::strtof(begin, nullptr))
                                          : static_cast<T>(std::strtod(begin, nullptr));
    if (error != std::errc()) return std::nullopt;
    return number;
}

}  // namespace timeseries
