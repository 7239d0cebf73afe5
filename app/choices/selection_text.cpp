#include "app/choices/selection_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/choices/decimals.h"

namespace app {
namespace {

using timeseries::Range;
using timeseries::RangeSet;
using timeseries::SortedStep;

// A decimal share is no binary one: 0.1 % of 1000 is 1, not a trifle more.
constexpr double kSlack = 1e-12;

std::string withoutSpaces(std::string_view text) {
    std::string out(text);
    std::erase_if(out, [](char c) { return c == ' ' || c == '\t'; });
    return out;
}

// "0.1%" -> 0.001.
std::optional<double> shareIn(std::string_view text) {
    if (text.empty() || text.back() != '%') return std::nullopt;
    text.remove_suffix(1);
    double percent = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), percent);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    if (!(percent >= 0 && percent <= 100)) return std::nullopt;
    return percent / 100;
}

// How many points are at least a share of them, and at most.
std::uint64_t atLeast(double share, std::uint64_t points) {
    const double exact = share * static_cast<double>(points);
    return std::min(points, static_cast<std::uint64_t>(std::ceil(exact * (1 - kSlack))));
}
std::uint64_t atMost(double share, std::uint64_t points) {
    const double exact = share * static_cast<double>(points);
    return std::min(points, static_cast<std::uint64_t>(std::floor(exact * (1 + kSlack))));
}

// A point's value; a float in the fewest digits of which it is the nearest float, so that a field
// shows -1.8312 for it and not -1.8312000036239624.
timeseries::Number valueAt(const SortedStep& step, std::uint64_t point) {
    const timeseries::Number value = step.value(point);
    if (step.type() != timeseries::ValueType::F32) return value;
    return shortestIn(step.type(), timeseries::toDouble(value));
}

// The quantiles as a range of values; none where the text is not one. REQUIRES: a point.
std::optional<Range> quantiles(std::string_view text, const SortedStep& step) {
    const std::uint64_t points = step.size();
    const auto sideOf = [&](std::string_view word) -> std::optional<std::uint64_t> {
        if (!text.starts_with(word)) return std::nullopt;
        const auto share = shareIn(text.substr(word.size()));
        if (!share || *share == 0) return std::nullopt;
        return std::max<std::uint64_t>(1, atLeast(*share, points));
    };
    if (const auto top = sideOf("top")) return Range{{valueAt(step, points - *top)}, {kInfinity}};
    if (const auto bottom = sideOf("bottom"))
        return Range{{-kInfinity}, {valueAt(step, *bottom - 1)}};
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto from = shareIn(text.substr(0, colon)), to = shareIn(text.substr(colon + 1));
    if (!from || !to || *from > *to) return std::nullopt;
    const std::uint64_t first = std::min(atMost(*from, points), points - 1);
    const std::uint64_t end = std::max(atLeast(*to, points), first + 1);
    return Range{{valueAt(step, first)}, {valueAt(step, end - 1)}};
}

}  // namespace

RangeSet parseSelection(std::string_view text, const SortedStep& step) {
    const std::string bare = withoutSpaces(text);
    const bool isShare = bare.find('%') != std::string::npos || bare.starts_with("top") ||
                         bare.starts_with("bottom");
    if (!isShare) return RangeSet::parse(text);
    if (step.size() == 0)
        throw std::invalid_argument(
            fmt::format("selection '{}': the step has no points to take a share of", text));
    const auto range = quantiles(bare, step);
    if (!range)
        throw std::invalid_argument(fmt::format(
            "selection '{}' is none of 'top 5 %', 'bottom 0.5 %' and '25 % : 75 %', shares "
            "ascending from 0 to 100, decimals behind a point",
            text));
    return step.keptPart(RangeSet(std::vector{*range}));
}

}  // namespace app
