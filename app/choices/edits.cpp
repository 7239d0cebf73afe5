#include "app/choices/edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "app/choices/choice_text.h"
#include "app/choices/clip_flaw.h"
#include "app/choices/decimals.h"
#include "app/choices/first_choice.h"
#include "app/choices/layer_colors.h"

namespace app {
namespace {

using timeseries::Bound;
using timeseries::Number;
using timeseries::Range;
using timeseries::RangeSet;
using timeseries::SortedStep;

// The double nearest to a number that is not less, not greater.
double atLeast(const Number& number) {
    const double d = timeseries::toDouble(number);
    return timeseries::compare(d, number) < 0 ? std::nextafter(d, kInfinity) : d;
}
double atMost(const Number& number) {
    const double d = timeseries::toDouble(number);
    return timeseries::compare(d, number) > 0 ? std::nextafter(d, -kInfinity) : d;
}
// The next greater, less, of all doubles or of those rounded to a resolution; no farther than where
// an end is already.
double above(const Number& number, double resolution, const Bound& end) {
    return std::min(roundedAbove(atMost(number), resolution), atLeast(end.value));
}
double below(const Number& number, double resolution, const Bound& end) {
    return std::max(roundedBelow(atLeast(number), resolution), atMost(end.value));
}

// The values between its neighbours, where a range may lie.
struct Room {
    double lo = -kInfinity, hi = kInfinity;
};
Room roomOf(const RangeSet& set, std::size_t range, double resolution) {
    const auto all = set.ranges();
    const Range& own = all[range];
    Room room;
    if (range > 0) room.lo = above(all[range - 1].hi.value, resolution, own.lo);
    if (range + 1 < all.size()) room.hi = below(all[range + 1].lo.value, resolution, own.hi);
    return room;
}

// With one range changed; the set as it was where no range would be left of it, or fewer of all
// (ends that no double lies between).
RangeSet replaced(const RangeSet& set, std::size_t range, const Range& by) {
    std::vector<Range> all(set.ranges().begin(), set.ranges().end());
    all[range] = by;
    RangeSet changed(std::move(all));
    return changed.ranges().size() == set.ranges().size() ? changed : set;
}

// The finite value to which an end must come to pass one more of the ascending values. Compared as
// selections are: floats as floats.
std::optional<double> valuePassed(const SortedStep& step, double from, End end, bool up) {
    const bool floats = step.type() == timeseries::ValueType::F32;
    double edge = floats ? static_cast<double>(static_cast<float>(from)) : from;
    // Inwards, the outermost of what is selected is to be left out.
    const bool inward = up == (end == End::Lo);
    const auto beyond = [&](bool orAt) -> std::optional<double> {
        const std::uint64_t place =
            step.countBelow(up == orAt ? edge : std::nextafter(edge, kInfinity));
        if (up ? place == step.size() : place == 0) return std::nullopt;
        return timeseries::toDouble(step.value(up ? place : place - 1));
    };
    if (inward) {
        const auto outermost = beyond(true);
        if (!outermost) return std::nullopt;
        edge = *outermost;
    }
    const auto next = beyond(false);
    if (!next || !std::isfinite(*next)) return std::nullopt;
    // As it is written: the shortest text that means it.
    return floats ? shortestIn(timeseries::ValueType::F32, *next) : *next;
}

// Short enough for a field; floats that were stored as such read as they were written.
std::string sideText(double coordinate, int digits = kClipDigits) {
    return fmt::format("{:.{}g}", coordinate, digits);
}

// Of an axis, unbounded ends as its own.
Extent sideOf(const std::optional<ClipBox>& clip, const timeseries::Grid& grid, std::size_t axis) {
    const auto [least, most] = grid.ends(axis);
    if (!clip) return {least, most};
    const int i = static_cast<int>(axis);
    return {std::max(clip->lo[i], least), std::min(clip->hi[i], most)};
}

double asShown(double coordinate, int digits) {
    return std::strtod(sideText(coordinate, digits).c_str(), nullptr);
}

// Unbounded where nothing is said.
Extent typedSide(std::string_view text) {
    if (std::ranges::all_of(text, [](char c) { return c == ' '; })) return {-kInfinity, kInfinity};
    try {
        const RangeSet set = RangeSet::parse(text);
        if (set.ranges().size() != 1)
            throw ChoiceError(fmt::format("clip '{}': one side of a box is one range", text));
        const Range& range = set.ranges().front();
        if (range.lo.open || range.hi.open)
            throw ChoiceError(
                fmt::format("clip '{}': a box has closed ends, without brackets", text));
        return {timeseries::toDouble(range.lo.value), timeseries::toDouble(range.hi.value)};
    } catch (const timeseries::RangeSyntaxError& error) {
        throw ChoiceError(fmt::format("clip '{}': {}", text, error.what()));
    }
}

bool isBounded(const Bound& bound) { return std::isfinite(timeseries::toDouble(bound.value)); }

// What of these ranges is in none of the others.
RangeSet without(RangeSet ranges, const RangeSet& others) {
    const auto beside = [](const Bound& end) { return Bound{end.value, !end.open}; };
    const auto inner = [](const Bound& a, const Bound& b, bool isLow) {
        const auto order = timeseries::compare(a.value, b.value);
        return (isLow ? order > 0 : order < 0) || (order == 0 && a.open) ? a : b;
    };
    for (const Range& other : others.ranges()) {
        std::vector<Range> parts;
        for (const Range& range : ranges.ranges()) {
            parts.push_back({range.lo, inner(range.hi, beside(other.lo), false)});
            parts.push_back({inner(range.lo, beside(other.hi), true), range.hi});
        }
        ranges = RangeSet(std::move(parts));
    }
    return ranges;
}

}  // namespace

RangeSet withEnd(const RangeSet& ranges, std::size_t range, End end, double value,
                 double resolution) {
    assert(range < ranges.ranges().size());
    Range changed = ranges.ranges()[range];
    Room room = roomOf(ranges, range, resolution);
    // A range with an open end holds nothing where its ends meet.
    const bool meets = !changed.lo.open && !changed.hi.open;
    if (end == End::Lo)
        room.hi =
            meets ? atMost(changed.hi.value) : below(changed.hi.value, resolution, changed.lo);
    else
        room.lo =
            meets ? atLeast(changed.lo.value) : above(changed.lo.value, resolution, changed.hi);
    if (!(room.lo <= room.hi)) return ranges;
    (end == End::Lo ? changed.lo : changed.hi).value = std::clamp(value, room.lo, room.hi);
    return replaced(ranges, range, changed);
}

double steppedEnd(const SortedStep& step, double from, End end, int by, double resolution) {
    const bool up = by > 0;
    const auto passed = valuePassed(step, from, end, up);
    if (!passed) return from;
    const double steps = roundedTo(from + by * resolution, resolution);
    return up ? std::max(steps, *passed) : std::min(steps, *passed);
}

RangeSet withMoved(const RangeSet& ranges, std::size_t range, double by, double resolution) {
    assert(range < ranges.ranges().size());
    Range moved = ranges.ranges()[range];
    const double lo = timeseries::toDouble(moved.lo.value);
    const double hi = timeseries::toDouble(moved.hi.value);
    if (!isBounded(moved.lo) && !isBounded(moved.hi)) return ranges;
    if (!isBounded(moved.lo))
        return withEnd(ranges, range, End::Hi, decimalSum(hi, by), resolution);
    if (!isBounded(moved.hi))
        return withEnd(ranges, range, End::Lo, decimalSum(lo, by), resolution);
    Room room = roomOf(ranges, range, resolution);
    room = {std::max(room.lo, -kMostFinite), std::min(room.hi, kMostFinite)};
    // The end in front is stopped; the other follows at its distance.
    const double width = decimalSum(hi, -lo);
    if (by < 0) {
        const double front = std::max(decimalSum(lo, by), room.lo);
        moved.lo.value = front;
        moved.hi.value = std::min(decimalSum(front, width), room.hi);
    } else {
        const double front = std::min(decimalSum(hi, by), room.hi);
        moved.hi.value = front;
        moved.lo.value = std::max(decimalSum(front, -width), room.lo);
    }
    return replaced(ranges, range, moved);
}

RangeSet without(const RangeSet& ranges, std::size_t range) {
    assert(range < ranges.ranges().size());
    std::vector<Range> rest(ranges.ranges().begin(), ranges.ranges().end());
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(range));
    return RangeSet(std::move(rest));
}

RangeSet with(const RangeSet& ranges, const Range& added) {
    std::vector<Range> all(ranges.ranges().begin(), ranges.ranges().end());
    all.push_back(added);
    return RangeSet(std::move(all));
}

std::optional<ClipBox> withClipEnd(const std::optional<ClipBox>& clip, const timeseries::Grid& grid,
                                   std::size_t axis, End end, double coordinate) {
    const auto [least, most] = grid.ends(axis);
    const ClipBox open{glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
    ClipBox box = clip.value_or(open);
    double &lo = box.lo[static_cast<int>(axis)], &hi = box.hi[static_cast<int>(axis)];
    if (end == End::Lo)
        lo = coordinate <= least ? -kInfinity : std::min(coordinate, std::min(hi, most));
    else
        hi = coordinate >= most ? kInfinity : std::max(coordinate, std::max(lo, least));
    return box == open ? std::nullopt : std::optional(box);
}

std::optional<ClipBox> withClipSide(const std::optional<ClipBox>& clip,
                                    const timeseries::Grid& grid, std::size_t axis,
                                    std::string_view text, int digits) {
    const ClipBox open{glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
    ClipBox box = clip.value_or(open);
    double &nowLo = box.lo[static_cast<int>(axis)], &nowHi = box.hi[static_cast<int>(axis)];
    auto [lo, hi] = typedSide(text);
    const auto [least, most] = grid.ends(axis);
    if (lo == hi && std::isfinite(lo)) {
        // What reads as an end of the axis may lie beyond it.
        const std::string typed = sideText(lo, digits);
        const auto readsAs = [&](double end) { return sideText(end, digits) == typed; };
        const bool isWithin = (least <= lo && lo <= most) || readsAs(least) || readsAs(most);
        if (isWithin && !grid.mesh())  // whose points lie in none, which is told below
            lo = hi = grid.nearestPlane(axis, lo);
    } else {
        const auto [shownLo, shownHi] = sideOf(clip, grid, axis);
        if (sideText(lo) == sideText(least)) lo = -kInfinity;
        if (sideText(hi) == sideText(most)) hi = kInfinity;
        if (lo == asShown(shownLo, digits)) lo = nowLo;
        if (hi == asShown(shownHi, digits)) hi = nowHi;
    }
    nowLo = lo;
    nowHi = hi;
    if (const std::string flaw = clipFlaw(box, grid); !flaw.empty()) throw ChoiceError(flaw);
    return box == open ? std::nullopt : std::optional(box);
}

std::string clipSideText(const std::optional<ClipBox>& clip, const timeseries::Grid& grid,
                         std::size_t axis, int digits) {
    const auto [lo, hi] = sideOf(clip, grid, axis);
    const std::string low = sideText(lo, digits);
    return lo == hi ? low : fmt::format("{}:{}", low, sideText(hi, digits));
}

int clipDigits(const std::optional<ClipBox>& clip, const timeseries::Grid& grid, std::size_t axis,
               const std::function<bool(std::string_view text)>& fits) {
    constexpr int kFewest = 3;
    const Extent side = sideOf(clip, grid, axis);
    int digits = kClipDigits;
    while (digits > kFewest && !fits(clipSideText(clip, grid, axis, digits)) &&
           (side.lo == side.hi || sideText(side.lo, digits - 1) != sideText(side.hi, digits - 1)))
        --digits;
    return digits;
}

void removeLayer(Explorer& explorer, std::size_t layer) {
    // Values alone were to play: without them time is what is left.
    if (explorer.layers[layer].motion) explorer.play.timeMoves = true;
    explorer.layers.erase(explorer.layers.begin() + static_cast<std::ptrdiff_t>(layer));
    explorer.noLayers = explorer.layers.empty();
}

RangeSet newRanges(const Explorer& explorer, const SortedStep& step) {
    constexpr std::array kShares = {"top 1 %",     "bottom 1 %",  "top 5 %",     "bottom 5 %",
                                    "45 % : 55 %", "70 % : 80 %", "20 % : 30 %", "80 % : 95 %",
                                    "5 % : 20 %",  "55 % : 70 %", "30 % : 45 %"};
    if (step.size() == 0) return RangeSet::everything();
    std::vector<RangeSet> taken, offered;
    for (const LayerChoice& layer : explorer.layers) taken.push_back(layer.ranges);
    const RangeSet all = timeseries::unionOf(taken);
    for (const char* share : kShares) {
        offered.push_back(parseSelection(share, step));
        RangeSet apart = without(offered.back(), all);
        if (step.count(step.keptPart(apart)) > 0) return apart;
    }
    const auto isOther = [&](const RangeSet& ranges) {
        return std::ranges::find(taken, ranges) == taken.end();
    };
    const auto other = std::ranges::find_if(offered, isOther);
    return other != offered.end() ? *other : offered.front();
}

std::size_t addLayer(Explorer& explorer, RangeSet ranges, const SortedStep& step) {
    assert(explorer.layers.size() < render::kMaxLayers);
    const auto isTaken = [&](const glm::dvec3& color) {
        const auto has = [&](const LayerChoice& layer) {
            const auto* rgb = layer.color ? std::get_if<glm::dvec3>(&*layer.color) : nullptr;
            return rgb != nullptr && *rgb == color;
        };
        return std::ranges::any_of(explorer.layers, has);
    };
    LayerChoice layer;
    layer.color = *std::ranges::find_if_not(kLayerColors, isTaken);
    layer.opacity = opacityFor(step.count(step.keptPart(ranges)), step.grid());
    layer.ranges = std::move(ranges);
    explorer.layers.push_back(std::move(layer));
    explorer.noLayers = false;
    return explorer.layers.size() - 1;
}

}  // namespace app
