#include "app/picture/range_label.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "app/choices/decimals.h"
#include "render/annotate/ticks.h"

namespace app {
namespace {

using timeseries::Range;
using timeseries::RangeSet;

constexpr double kPlain = 1e9;  // whole numbers below have no exponent
constexpr double kLeastResolution = std::numeric_limits<double>::min();

// The text of a bound, the same whether a file, a user or a session wrote it. Doubles of many
// digits, as a swept window has, are rounded to these.
struct BoundText {
    std::string text;
    bool isRounded = false;
    bool isNoShorter = false;  // rounded, it would be as long: it is exact
};
BoundText boundText(const timeseries::Number& number, int digits) {
    const double value = timeseries::toDouble(number);
    std::string exact = timeseries::toText(number);
    if (!std::isfinite(value)) return {exact};
    const bool isWhole = !std::holds_alternative<double>(number) || std::trunc(value) == value;
    if (isWhole && std::abs(value) < kPlain) return {fmt::format("{:.0f}", value + 0.0)};
    std::string few = fmt::format("{:.{}g}", value, digits);
    const bool isRounded = timeseries::compare(std::strtod(few.c_str(), nullptr), number) != 0;
    if (few.size() >= exact.size() || (isWhole && isRounded)) return {exact, false, isRounded};
    return {few, isRounded};
}

constexpr int kExact = 17;

// Where the first digit of a number stands; none of those that have none.
std::optional<int> firstPlace(const timeseries::Number& number) {
    const double value = std::abs(timeseries::toDouble(number));
    if (!(value > 0 && std::isfinite(value))) return std::nullopt;
    return static_cast<int>(std::floor(std::log10(value)));
}

// As long as "-1000000000.5", which reads as well as a rounded one.
bool isShort(const timeseries::Number& number) {
    constexpr std::size_t kShort = 13;
    const double value = timeseries::toDouble(number);
    const bool isLarge = std::isfinite(value) && std::abs(value) >= kPlain;
    return timeseries::toText(number).size() <= kShort && !(isLarge && std::trunc(value) == value);
}

struct EndTexts {
    BoundText lo, hi;
};
// Ends of one size are told to the same place, the last of so many digits of the larger one; an end
// that is much smaller has as many of its own.
EndTexts endTexts(const Range& range, int digits) {
    const timeseries::Number &lo = range.lo.value, &hi = range.hi.value;
    if (isShort(lo) && isShort(hi)) return {boundText(lo, kExact), boundText(hi, kExact)};
    const auto loPlace = firstPlace(lo), hiPlace = firstPlace(hi);
    if (!loPlace || !hiPlace || std::abs(*loPlace - *hiPlace) > 1)
        return {boundText(lo, digits), boundText(hi, digits)};
    const int larger = std::max(*loPlace, *hiPlace);
    const EndTexts texts{boundText(lo, digits - larger + *loPlace),
                         boundText(hi, digits - larger + *hiPlace)};
    if (!texts.lo.isNoShorter && !texts.hi.isNoShorter) return texts;
    return {boundText(lo, kExact), boundText(hi, kExact)};
}

// Whether the range that is told is as wide as the range, or nearly so.
bool isWidthTold(const Range& range, const EndTexts& texts) {
    constexpr double kNearly = 0.05;
    const double width =
        timeseries::toDouble(range.hi.value) - timeseries::toDouble(range.lo.value);
    if ((!texts.lo.isRounded && !texts.hi.isRounded) || std::isinf(width)) return true;
    const double told =
        std::strtod(texts.hi.text.c_str(), nullptr) - std::strtod(texts.lo.text.c_str(), nullptr);
    return std::abs(told - width) <= kNearly * width;
}

// As few digits (at least seven) as tell all bounds apart that differ, and how wide ranges are.
int digitsOf(const RangeSet& ranges) {
    constexpr int kFew = 7;
    for (int digits = kFew; digits < kExact; ++digits) {
        std::map<std::string, std::string> exact;  // of each rounded text
        const auto isTold = [&](const timeseries::Number& bound, const BoundText& text) {
            const std::string whole = timeseries::toText(bound);
            return exact.emplace(text.text, whole).first->second == whole;
        };
        if (std::ranges::all_of(ranges.ranges(), [&](const Range& range) {
                const EndTexts texts = endTexts(range, digits);
                return isTold(range.lo.value, texts.lo) && isTold(range.hi.value, texts.hi) &&
                       isWidthTold(range, texts);
            }))
            return digits;
    }
    return kExact;
}
}  // namespace

std::string rangeLabel(const RangeSet& ranges, const std::string& units) {
    std::string text;
    bool rounded = false;
    const int digits = digitsOf(ranges);
    for (const Range& r : ranges.ranges()) {
        const auto isUnbounded = [](const timeseries::Bound& b, double end) {
            return timeseries::toDouble(b.value) == end && !b.open;
        };
        const bool down = isUnbounded(r.lo, -kInfinity), up = isUnbounded(r.hi, kInfinity);
        const EndTexts ends = endTexts(r, digits);
        rounded = rounded || ends.lo.isRounded || ends.hi.isRounded;
        const std::string lo = render::withMinusSigns(ends.lo.text),
                          hi = render::withMinusSigns(ends.hi.text);
        if (!text.empty()) text += ", ";
        if (down && up) return "all values";
        if (lo == hi)
            text += lo;
        else if (down)
            text += fmt::format("{} {}", r.hi.open ? "<" : "≤", hi);
        else if (up)
            text += fmt::format("{} {}", r.lo.open ? ">" : "≥", lo);
        else if (r.lo.open || r.hi.open)
            text += fmt::format("{}{}, {}{}", r.lo.open ? '(' : '[', lo, hi, r.hi.open ? ')' : ']');
        else
            text += fmt::format("{} to {}", lo, hi);
    }
    if (text.empty()) return "no values";
    if (rounded) text = "≈ " + text;
    const std::string unit = render::shownUnit(units);
    return unit.empty() ? text : text + " " + unit;
}

std::string classLabel(const RangeSet& ranges, const timeseries::Variable& variable) {
    constexpr std::size_t kFew = 4;
    std::vector<std::string_view> names;
    const auto intervals = ranges.toIntervals<double>();
    for (const timeseries::ClassName& each : variable.classes)
        if (std::ranges::any_of(
                intervals, [&](const auto& i) { return i.lo <= each.value && each.value <= i.hi; }))
            names.push_back(each.name);
    return names.size() > kFew ? "" : fmt::format("{}", fmt::join(names, ", "));
}

std::string sweptText(const timeseries::ValueSweep& sweep, std::int64_t tick) {
    const timeseries::Number exact = sweep.exactContour(tick);
    const double delta = sweep.settings().delta, contour = timeseries::toDouble(exact);
    // As many decimals at every tick: the text does not tremble while it plays.
    const double resolution =
        delta > 0 ? delta / 50 : std::max(1e-6 * std::abs(contour), kLeastResolution);
    const int decimals = static_cast<int>(std::ceil(-std::log10(resolution)));
    const bool isPlain = decimals <= 9 && std::abs(contour) < 1e9;
    const std::string centre =
        !std::holds_alternative<double>(exact) ? timeseries::toText(exact)
        : isPlain ? fmt::format("{:.{}f}", roundedTo(contour, resolution), std::max(0, decimals))
                  : timeseries::toText(roundedTo(contour, resolution));
    return render::withMinusSigns(centre) + " ± " + timeseries::toText(delta);
}
std::string clipLabel(const ClipBox& clip, const timeseries::Grid& grid) {
    std::vector<std::string> sides;
    for (int a = 0; a < 3; ++a) {
        const Range side{{clip.lo[a]}, {clip.hi[a]}};
        if (std::isinf(clip.lo[a]) && std::isinf(clip.hi[a])) continue;
        const timeseries::Axis& axis = grid.axes()[static_cast<std::size_t>(a)];
        sides.push_back(axis.name + " " + rangeLabel(RangeSet({side}), axis.units));
    }
    return fmt::format("{}", fmt::join(sides, ", "));
}

}  // namespace app
