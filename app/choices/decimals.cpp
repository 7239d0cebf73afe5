#include "app/choices/decimals.h"

#include <fmt/format.h>

#include <algorithm>
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
    return number + 0.0;  // no -0
}

double powerOfTen(int exponent) { return numberOf(fmt::format("1e{}", exponent), 0); }

// REQUIRES: finite, > 0.
int decimalsAt(double resolution) {
    const int decimals = static_cast<int>(std::ceil(-std::log10(resolution)));
    // log10 is not exact at powers of ten.
    return powerOfTen(1 - decimals) <= resolution ? decimals - 1 : decimals;
}

// Of the shortest text that reads back as it.
int decimalsOf(double value) {
    const std::string text = fmt::format("{}", value);
    const std::size_t power = std::min(text.find('e'), text.size()), point = text.find('.');
    int exponent = 0;
    if (power < text.size()) exponent = std::stoi(text.substr(power + 1));
    return (point < power ? static_cast<int>(power - point) - 1 : 0) - exponent;
}

}  // namespace

double toDecimals(double value, int decimals) {
    if (decimals >= 0) return numberOf(fmt::format("{:.{}f}", value, decimals), value);
    return numberOf(fmt::format("{:.0f}e{}", value / powerOfTen(-decimals), -decimals), value);
}

double roundedTo(double value, double resolution) {
    if (!std::isfinite(value) || !std::isfinite(resolution)) return value;
    return toDecimals(value, decimalsAt(resolution));
}

double roundedAbove(double value, double resolution) {
    return 0.0 - roundedBelow(-value, resolution);  // no -0
}

double roundedBelow(double value, double resolution) {
    const double next = std::nextafter(value, -timeseries::kInfinity);
    if (!std::isfinite(value) || !std::isfinite(resolution) || !(resolution > 0)) return next;
    const int decimals = decimalsAt(resolution);
    double rounded = toDecimals(value, decimals);
    if (!(rounded < value)) rounded = toDecimals(rounded - powerOfTen(-decimals), decimals);
    return rounded < value ? rounded : next;
}

int digitsApart(double size, double apart, int least) {
    constexpr int kMost = std::numeric_limits<double>::max_digits10;
    const double times = std::abs(size / apart);
    if (!std::isfinite(times) || !(times > 1)) return least;
    return std::clamp(2 + static_cast<int>(std::log10(times)), least, kMost);
}

double decimalSum(double a, double b) {
    const double sum = a + b;
    if (!std::isfinite(sum)) return sum;
    return toDecimals(sum, std::max(decimalsOf(a), decimalsOf(b)));
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
