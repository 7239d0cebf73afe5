// What several commands' options share.
#pragma once

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "app/choices/choice_text.h"

namespace app {

inline constexpr const char* kRangeHelp =
    "lo:hi, [lo,hi) with open ends, c~d for c plus or minus d, '>c', '<=c', min, max; commas in "
    "one layer, repeat the option for a new layer";

inline constexpr const char* kFileHelp =
    "A file, any file of a numbered series, a folder, a pattern, or several files that make one "
    "series";

// Numbers are kept as text until parseNumber() reads them: CLI11 reads them by way of long doubles,
// which rounds twice.
inline CLI::Validator between(double lo, double hi) {
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            try {
                const double value = parseNumber("", text);
                if (value >= lo && value <= hi) return {};
            } catch (const ChoiceError&) {
            }
            return hi == kMostFinite
                       ? fmt::format("'{}' is not a finite number of at least {}", text, lo)
                       : fmt::format("'{}' is not a number from {} to {}", text, lo, hi);
        },
        hi == kMostFinite ? fmt::format("at least {}", lo) : fmt::format("{} to {}", lo, hi));
}

inline CLI::Validator wholeBetween(std::size_t lo, std::size_t hi) {
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            std::size_t value = 0;
            const char* const end = text.data() + text.size();
            const auto [past, error] = std::from_chars(text.data(), end, value);
            if (error == std::errc{} && past == end && value >= lo && value <= hi) return {};
            return fmt::format("'{}' is not a whole number from {} to {}", text, lo, hi);
        },
        fmt::format("{} to {}", lo, hi));
}

inline CLI::Validator oneOf(std::vector<std::string> words) {
    const std::string known = fmt::format("{}", fmt::join(words, ", "));
    return CLI::Validator(
        [words = std::move(words), known](std::string& text) -> std::string {
            if (std::ranges::find(words, text) != words.end()) return {};
            return fmt::format("'{}' is not one of {}", text, known);
        },
        known);
}

// 500MB, 64GiB, or bytes: CLI11's units. Becomes bytes, at least one.
inline CLI::Validator sizeOfBytes() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            std::string read = text;
            try {
                // It takes signs and units alone, too.
                if (!text.empty() && text[0] >= '1' && text[0] <= '9' &&
                    CLI::AsSizeValue(true)(read).empty()) {
                    text = read;
                    return {};
                }
            } catch (const CLI::ValidationError&) {
            }
            return fmt::format("'{}' is not a size such as 500MB or 64GiB", text);
        },
        "SIZE");
}

inline CLI::Validator notEmpty() {
    return CLI::Validator(
        [](std::string& text) { return std::string(text.empty() ? "is an empty text" : ""); }, "");
}

inline bool given(const CLI::App& app, const char* option) { return app.count(option) > 0; }

}  // namespace app
