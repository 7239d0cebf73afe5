// Numbers in the text of VTK files, as VTK reads them, but for those that it wraps or takes in
// part.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace timeseries {

// All of the text as a number of the type: nothing when it is none, beyond the type's range or not
// finite.
template <typename T>
std::optional<T> vtkNumber(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    T number{};
    const char* const last = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), last, number);
    if (stop != last) return std::nullopt;
    if constexpr (std::floating_point<T>) {
        // Too small to be told from 0 is a number, too large is none.
        if (error == std::errc::result_out_of_range &&
            std::abs(std::strtod(std::string(text).c_str(), nullptr)) < 1)
            return T{0};
        if (!std::isfinite(number)) return std::nullopt;
    }
    if (error != std::errc()) return std::nullopt;
    return number;
}

}  // namespace timeseries
