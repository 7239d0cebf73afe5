#include "timeseries/index/number.h"

#include <fmt/format.h>

#include <cmath>

namespace timeseries {
namespace {

// 2^63 and 2^64: the first doubles beyond the integer types, both exact.
constexpr double kTwo63 = 9223372036854775808.0;
constexpr double kTwo64 = 18446744073709551616.0;

std::partial_ordering order(std::int64_t a, std::uint64_t b) {
    if (a < 0) return std::partial_ordering::less;
    return static_cast<std::uint64_t>(a) <=> b;
}

// Integers compare with the double's integral part as integers; its fraction breaks the tie.
template <typename Int>
std::partial_ordering orderInteger(Int a, double b, double lowest, double beyond) {
    if (std::isnan(b)) return std::partial_ordering::unordered;
    if (b < lowest) return std::partial_ordering::greater;
    if (b >= beyond) return std::partial_ordering::less;
    const double whole = std::floor(b);
    const auto integral = static_cast<Int>(whole);
    if (a != integral) return a <=> integral;
    return whole < b ? std::partial_ordering::less : std::partial_ordering::equivalent;
}

std::partial_ordering order(double a, double b) { return a <=> b; }
std::partial_ordering order(std::int64_t a, std::int64_t b) { return a <=> b; }
std::partial_ordering order(std::uint64_t a, std::uint64_t b) { return a <=> b; }
std::partial_ordering order(std::int64_t a, double b) {
    return orderInteger(a, b, -kTwo63, kTwo63);
}
std::partial_ordering order(std::uint64_t a, double b) { return orderInteger(a, b, 0.0, kTwo64); }
std::partial_ordering order(std::uint64_t a, std::int64_t b) { return 0 <=> order(b, a); }
std::partial_ordering order(double a, std::int64_t b) { return 0 <=> order(b, a); }
std::partial_ordering order(double a, std::uint64_t b) { return 0 <=> order(b, a); }

}  // namespace

std::partial_ordering compare(const Number& a, const Number& b) {
    return std::visit([](auto x, auto y) { return order(x, y); }, a, b);
}

double toDouble(const Number& number) {
    return std::visit([](auto x) { return static_cast<double>(x); }, number);
}

std::string toText(const Number& number) {
    // fmt prints the shortest digits that read back as the same double.
    return std::visit([](auto x) { return fmt::format("{}", x); }, number);
}

}  // namespace timeseries
