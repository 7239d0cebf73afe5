#include "render/annotate/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace render {
namespace {

constexpr const char* kMinus = "\u2212";

// The double nearest to digits * 10^exponent, which may be 0 or infinite.
double decimal(std::int64_t digits, int exponent) {
    const std::string text = fmt::format("{}e{}", digits, exponent);
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec == std::errc::result_out_of_range && exponent > 0)
        return std::copysign(std::numeric_limits<double>::infinity(), static_cast<double>(digits));
    return value;
}

struct Step {
    int mantissa, exponent;
    double length() const { return decimal(mantissa, exponent); }
    double multiple(std::int64_t n) const { return decimal(n * mantissa, exponent); }
};

// The first and last multiple of the step in [lo, hi]; none when first > last.
struct Multiples {
    std::int64_t first, last;
    double count() const { return static_cast<double>(last - first + 1); }
};
std::optional<Multiples> multiples(Step step, double lo, double hi) {
    // Beyond this, neighbouring multiples are no longer different doubles.
    constexpr double kMost = 4e15;
    const double from = lo / step.length(), to = hi / step.length();
    if (!(std::abs(from) < kMost && std::abs(to) < kMost)) return std::nullopt;
    // The quotients may be off by a rounding: the multiples themselves decide.
    Multiples m{std::llround(from) - 1, std::llround(to) + 1};
    while (m.first <= m.last && step.multiple(m.first) < lo) ++m.first;
    while (m.last >= m.first && step.multiple(m.last) > hi) --m.last;
    if (m.first > m.last) return std::nullopt;
    return m;
}

}  // namespace

std::vector<double> niceTicks(double lo, double hi, int wanted) {
    assert(lo <= hi && wanted >= 1);
    // Divided before the difference, which may overflow; for one tick it still may.
    const double rough = std::min(hi / wanted - lo / wanted, std::numeric_limits<double>::max());
    if (!(rough > 0)) return {lo};
    const int decade = static_cast<int>(std::floor(std::log10(rough)));
    Step best{0, 0};
    Multiples ticks{0, -1};
    double least = std::numeric_limits<double>::infinity();
    for (int exponent = std::max(decade - 1, -323); exponent <= std::min(decade + 1, 308);
         ++exponent) {
        for (const int mantissa : {1, 2, 5}) {
            const Step step{mantissa, exponent};
            if (!std::isfinite(step.length()) || step.length() == 0) continue;
            const auto found = multiples(step, lo, hi);
            if (!found) continue;
            const double off = std::abs(std::log(found->count() / wanted));
            if (off < least) {
                least = off;
                best = step;
                ticks = *found;
            }
        }
    }
    std::vector<double> values;
    for (std::int64_t n = ticks.first; n <= ticks.last; ++n) values.push_back(best.multiple(n));
    if (values.empty()) values.push_back(lo);  // neighbouring doubles: nothing rounder between
    return values;
}

namespace {

// Shortest decimal form: 0.25 is digits "25", exponent -1 (of the first digit).
struct Decimal {
    int digitCount, exponent;
};
Decimal shortest(double value) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), std::abs(value),
                                   std::chars_format::scientific);
    const std::string_view written(text.data(), static_cast<std::size_t>(end.ptr - text.data()));
    const std::size_t e = written.find('e');
    const auto digits = static_cast<int>(e > 1 ? e - 1 : 1);  // without the point
    const std::string_view power = written.substr(written[e + 1] == '+' ? e + 2 : e + 1);
    int exponent = 0;
    std::from_chars(power.data(), power.data() + power.size(), exponent);
    return {digits, exponent};
}

std::string superscript(std::string_view number) {
    constexpr std::array<const char*, 10> kDigits = {"\u2070", "\u00b9", "\u00b2", "\u00b3",
                                                     "\u2074", "\u2075", "\u2076", "\u2077",
                                                     "\u2078", "\u2079"};
    std::string text;
    for (const char c : number)
        text += c == '-' ? "\u207b" : kDigits[static_cast<std::size_t>(c - '0')];
    return text;
}

}  // namespace

std::vector<std::string> tickTexts(std::span<const double> ticks) {
    int decimals = 0, exponent = std::numeric_limits<int>::min();
    bool first = true;
    for (const double tick : ticks) {
        if (tick == 0) continue;
        const Decimal d = shortest(tick);
        const int needed = d.digitCount - 1 - d.exponent;
        decimals = first ? needed : std::max(decimals, needed);
        exponent = std::max(exponent, d.exponent);
        first = false;
    }
    if (first) return std::vector<std::string>(ticks.size(), "0");
    const int plain = std::max(exponent, 0) + 1 + (decimals > 0 ? decimals + 1 : 0);
    const int mantissaDecimals = exponent + decimals;
    const int powers = 1 + (mantissaDecimals > 0 ? mantissaDecimals + 1 : 0) + 4;
    const bool usePlain = (exponent <= 5 && plain <= 6) || plain <= powers;
    std::vector<std::string> texts;
    for (const double tick : ticks) {
        std::string text;
        if (tick == 0 && !usePlain) {
            text = "0";
        } else if (usePlain) {
            text = fmt::format("{:.{}f}", std::abs(tick), std::max(decimals, 0));
        } else {
            // A mantissa against the common exponent, through the decimal text: dividing by a power
            // of ten would round.
            const std::string digits =
                fmt::format("{:.{}e}", std::abs(tick), std::max(shortest(tick).digitCount - 1, 0));
            const std::size_t e = digits.find('e');
            double mantissa = 0;
            const std::string shifted =
                digits.substr(0, e) + fmt::format("e{}", shortest(tick).exponent - exponent);
            std::from_chars(shifted.data(), shifted.data() + shifted.size(), mantissa);
            text = fmt::format("{:.{}f}\u00d710{}", mantissa, std::max(mantissaDecimals, 0),
                               superscript(std::to_string(exponent)));
        }
        texts.push_back(tick < 0 ? kMinus + text : text);
    }
    return texts;
}

std::vector<std::string> withoutCommonStart(std::vector<std::string> texts,
                                            const std::function<bool(const std::string&)>& fits) {
    if (texts.empty() || std::ranges::all_of(texts, fits)) return texts;
    const auto all = [&](const auto& have) { return std::ranges::all_of(texts, have); };
    const bool negative = all([](const std::string& text) { return text.starts_with(kMinus); });
    const std::size_t sign = negative ? std::string_view(kMinus).size() : 0;
    std::vector<std::string> shorter = texts;
    for (std::size_t left = 1;; ++left) {  // bytes are digits and points behind the sign
        const auto sameDigit = [&](const std::string& text) {
            const std::size_t at = sign + left - 1;
            return text.size() > at + 1 && text[at] == texts[0][at] &&
                   static_cast<unsigned char>(text[at]) < 0x80;
        };
        if (!all(sameDigit)) return shorter;
        for (std::size_t i = 0; i < texts.size(); ++i)
            shorter[i] = texts[i].substr(0, sign) + "\u2026" + texts[i].substr(sign + left);
        if (std::ranges::all_of(shorter, fits)) return shorter;
    }
}

LabelledTicks fittingTicks(double lo, double hi, int wanted,
                           const std::function<bool(const std::string&)>& fits) {
    LabelledTicks best;
    std::ptrdiff_t most = -1;
    for (int n = wanted; n >= 1; --n) {
        LabelledTicks labels{niceTicks(lo, hi, n), {}};
        labels.texts = withoutCommonStart(tickTexts(labels.ticks), fits);
        const std::ptrdiff_t fitting = std::ranges::count_if(labels.texts, fits);
        if (fitting > 1 && fitting == std::ssize(labels.texts)) return labels;
        if (fitting <= most) continue;
        most = fitting;
        best = std::move(labels);
    }
    for (std::string& text : best.texts)
        if (!fits(text)) text.clear();
    return best;
}

std::string withMinusSigns(std::string_view number) {
    std::string text;
    for (const char c : number) text += c == '-' ? std::string(kMinus) : std::string(1, c);
    return text;
}

namespace {

// "s-1" is s⁻¹, and "m2" m² for the few units that are commonly squared; CO2 stays.
std::string shownFactor(const std::string& factor) {
    const std::size_t letters =
        static_cast<std::size_t>(std::find_if_not(factor.begin(), factor.end(),
                                                  [](unsigned char c) { return std::isalpha(c); }) -
                                 factor.begin());
    const std::string base = factor.substr(0, letters), power = factor.substr(letters);
    if (base.empty() || power.empty()) return factor;
    const bool negative = power[0] == '-';
    const std::string digits = power.substr(negative ? 1 : 0);
    if (digits.size() != 1 || digits[0] < '1' || digits[0] > '9') return factor;
    static const std::set<std::string> kSquared = {"m", "mm", "cm", "km", "s"};
    if (!negative && !kSquared.contains(base)) return factor;
    return base + superscript(power);
}

}  // namespace

std::string shownUnit(const std::string& unit) {
    if (unit == "1") return "";  // CF's word for a number without a unit
    for (const char* degree : {"degrees_", "degree_", "degrees", "degree"}) {
        if (!unit.starts_with(degree)) continue;
        const std::string rest = unit.substr(std::string_view(degree).size());
        if (rest.empty()) return "\u00b0";
        if (rest == "east" || rest == "E") return "\u00b0E";
        if (rest == "north" || rest == "N") return "\u00b0N";
        if (rest == "west" || rest == "W") return "\u00b0W";
        if (rest == "south" || rest == "S") return "\u00b0S";
        if (rest == "Celsius" || rest == "celsius" || rest == "C") return "\u00b0C";
    }
    if (unit == "degC" || unit == "deg_C" || unit == "Celsius" || unit == "celsius")
        return "\u00b0C";
    std::string shown, factor;
    for (const char c : unit) {
        if (c == ' ' || c == '/' || c == '.') {
            shown += shownFactor(factor) + c;
            factor.clear();
        } else {
            factor += c;
        }
    }
    return shown + shownFactor(factor);
}

}  // namespace render
