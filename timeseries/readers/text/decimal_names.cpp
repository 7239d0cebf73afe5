#include "timeseries/readers/text/decimal_names.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

namespace timeseries {
namespace {

// Digits on both sides of a dot.
struct Sides {
    std::string whole, fraction;
};

bool exponentFollows(const Name& name, std::size_t fraction) {
    constexpr std::array kExponents{"e", "e-", "e+", "E", "E-", "E+"};
    return fraction + 1 < name.digits.size() &&
           std::ranges::find(kExponents, name.texts[fraction + 1]) != kExponents.end();
}

bool lessAsWholes(const Sides& a, const Sides& b) {
    if (numberLess(a.whole, b.whole)) return true;
    return !numberLess(b.whole, a.whole) && numberLess(a.fraction, b.fraction);
}

// REQUIRES: fractions of one length, or without a needless 0, so that their texts tell.
bool lessAsDecimals(const Sides& a, const Sides& b) {
    if (numberLess(a.whole, b.whole)) return true;
    return !numberLess(b.whole, a.whole) && a.fraction < b.fraction;
}

bool needlessZero(const Sides& sides) {
    return sides.fraction.size() > 1 && sides.fraction.back() == '0';
}

// REQUIRES: ascending as wholes.
bool ascendAsDecimals(std::span<const Sides> all) {
    for (std::size_t i = 1; i < all.size(); ++i)
        if (lessAsWholes(all[i - 1], all[i]) != lessAsDecimals(all[i - 1], all[i]) ||
            lessAsDecimals(all[i], all[i - 1]))
            return false;
    return true;
}

// Each number before the dot but the last has several after it, the same one first, and lies
// farther from the next than these from each other: 1.1, 1.2, 2.1, 2.2, but not 0.0, 0.5, 1.0, 1.5,
// which go on evenly. REQUIRES: ascending as decimals.
bool beginAnew(std::span<const Sides> all) {
    const auto value = [](const Sides& sides) {
        return std::stod(withoutZeros(sides.whole) + '.' + sides.fraction);
    };
    double widestStep = 0, narrowestJump = std::numeric_limits<double>::infinity();
    std::size_t since = 0;  // where the number before the dot began
    for (std::size_t i = 1; i < all.size(); ++i) {
        const double gap = value(all[i]) - value(all[i - 1]);
        if (!numberLess(all[i - 1].whole, all[i].whole)) {
            widestStep = std::max(widestStep, gap);
            continue;
        }
        narrowestJump = std::min(narrowestJump, gap);
        if (i - since < 2 || all[i].fraction != all[0].fraction) return false;
        since = i;
    }
    constexpr double kRounding = 1e-6;
    return since > 0 && narrowestJump > widestStep * (1 + kRounding);
}

}  // namespace

std::vector<std::size_t> decimalPlaces(const Name& name) {
    std::vector<std::size_t> places;
    const auto dot = [&](std::size_t text) {
        return text > 0 && text < name.digits.size() && name.texts[text] == ".";
    };
    for (std::size_t at = 0; at + 1 < name.digits.size(); ++at)
        if (dot(at + 1) && !dot(at) && !dot(at + 2) && !exponentFollows(name, at + 1))
            places.push_back(at);
    return places;
}

Name withoutFractions(Name name) {
    const std::vector<std::size_t> places = decimalPlaces(name);
    for (std::size_t i = places.size(); i-- > 0;) {
        const auto after = static_cast<std::ptrdiff_t>(places[i]) + 1;
        name.texts.erase(name.texts.begin() + after);
        name.digits.erase(name.digits.begin() + after);
    }
    return name;
}

Dotted readingOf(std::span<const std::filesystem::path> files, std::size_t at) {
    std::vector<Sides> all;
    for (const std::filesystem::path& file : files) {
        const Name name = cut(file);
        if (isNegative(name.digits[at]) || std::ranges::find(name.powers, at) != name.powers.end())
            return Dotted::Decimal;
        all.push_back({name.digits[at], name.digits[at + 1]});
    }
    std::ranges::sort(all, lessAsWholes);
    const bool even = std::ranges::all_of(
        all, [&](const Sides& sides) { return sides.fraction.size() == all[0].fraction.size(); });
    if (!even && (std::ranges::any_of(all, needlessZero) || !ascendAsDecimals(all)))
        return Dotted::Unclear;
    const std::string first = withoutZeros(all.front().whole);
    if (first != "0" && first == withoutZeros(all.back().whole) &&
        std::ranges::any_of(all, [&](const Sides& s) { return s.fraction != all[0].fraction; }))
        return even ? Dotted::Whole : Dotted::Unclear;
    return beginAnew(all) ? Dotted::Whole : Dotted::Decimal;
}

}  // namespace timeseries
