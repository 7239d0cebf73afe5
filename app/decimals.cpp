#include "app/decimals.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>

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

}  // namespace app
