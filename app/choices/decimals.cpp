#include "app/choices/decimals.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace app {
namespace {

double numberOf(const std::string& text, double beyondDoubles) {
    double number = beyondDoubles;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

double powerOfTen(int exponent) { return numberOf(fmt::format("1e{}", exponent), 0); }

}  // namespace

double toDecimals(double value, int decimals) {
    if (decimals >= 0) return numberOf(fmt::format("{:.{}f}", value, decimals), value);
    return numberOf(fmt::format("{:.0f}e{}", value / powerOfTen(-decimals), -decimals), value);
}

double roundedTo(double value, double resolution) {
    if (!std::isfinite(value) || !std::isfinite(resolution)) return value;
    int decimals = static_cast<int>(std::ceil(-std::log10(resolution)));
    // log10 is not exact at powers of ten.
    if (powerOfTen(1 - decimals) <= resolution) --decimals;
    return toDecimals(value, decimals);
}

double shortestIn(timeseries::ValueType type, double value) {
    const bool isFloat = type == timeseries::ValueType::F32;
    if (!isFloat || !(std::abs(value) <= std::numeric_limits<float>::max())) return value;
    return numberOf(fmt::format("{}", static_cast<float>(value)), value);
}

timeseries::RangeSet shortestIn(timeseries::ValueType type, const timeseries::RangeSet& ranges) {
    std::vector<timeseries::Range> shorter;
    for (timeseries::Range range : ranges.ranges()) {
        for (timeseries::Bound* end : {&range.lo, &range.hi})
            if (const auto* value = std::get_if<double>(&end->value))
                end->value = shortestIn(type, *value);
        shorter.push_back(range);
    }
    timeseries::RangeSet told(std::move(shorter));
    return told.ranges().size() == ranges.ranges().size() ? told : ranges;
}

}  // namespace app
