#include "app/edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "app/first_choice.h"
#include "app/layer_colors.h"

namespace app {
namespace {

using timeseries::Bound;
using timeseries::Number;
using timeseries::Range;
using timeseries::RangeSet;
using timeseries::SortedStep;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The double nearest to a number that is not less, not greater, greater, less.
double atLeast(const Number& number) {
    const double d = timeseries::toDouble(number);
    return timeseries::compare(d, number) < 0 ? std::nextafter(d, kInfinity) : d;
}
double atMost(const Number& number) {
    const double d = timeseries::toDouble(number);
    return timeseries::compare(d, number) > 0 ? std::nextafter(d, -kInfinity) : d;
}
double above(const Number& number) { return std::nextafter(atMost(number), kInfinity); }
double below(const Number& number) { return std::nextafter(atLeast(number), -kInfinity); }

// The values between its neighbours, where a range may lie.
struct Room {
    double lo = -kInfinity, hi = kInfinity;
};
Room roomOf(const RangeSet& set, std::size_t range) {
    const auto all = set.ranges();
    Room room;
    if (range > 0) room.lo = above(all[range - 1].hi.value);
    if (range + 1 < all.size()) room.hi = below(all[range + 1].lo.value);
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
template <typename T>
std::optional<double> valuePassed(const std::vector<T>& values, double from, End end, bool up) {
    using Key = std::conditional_t<std::is_floating_point_v<T>, T, double>;
    const auto keyOf = [](T value) { return static_cast<Key>(value); };
    Key edge = static_cast<Key>(from);
    // Inwards, the outermost of what is selected is to be left out.
    const bool inward = up == (end == End::Lo);
    const auto beyond = [&](bool orAt) {
        if (up) {
            const auto found = orAt ? std::ranges::lower_bound(values, edge, {}, keyOf)
                                    : std::ranges::upper_bound(values, edge, {}, keyOf);
            return found == values.end() ? std::optional<Key>() : keyOf(*found);
        }
        const auto found = orAt ? std::ranges::upper_bound(values, edge, {}, keyOf)
                                : std::ranges::lower_bound(values, edge, {}, keyOf);
        return found == values.begin() ? std::optional<Key>() : keyOf(*std::prev(found));
    };
    if (inward) {
        const auto outermost = beyond(true);
        if (!outermost) return std::nullopt;
        edge = *outermost;
    }
    const auto next = beyond(false);
    if (!next || !std::isfinite(*next)) return std::nullopt;
    // As it is written: the shortest text that means it.
    return std::stod(fmt::format("{}", *next));
}

bool isBounded(const Bound& bound) { return std::isfinite(timeseries::toDouble(bound.value)); }

}  // namespace

RangeSet withEnd(const RangeSet& ranges, std::size_t range, End end, double value) {
    assert(range < ranges.ranges().size());
    Range changed = ranges.ranges()[range];
    Room room = roomOf(ranges, range);
    // A range with an open end holds nothing where its ends meet.
    const bool meets = !changed.lo.open && !changed.hi.open;
    if (end == End::Lo)
        room.hi = meets ? atMost(changed.hi.value) : below(changed.hi.value);
    else
        room.lo = meets ? atLeast(changed.lo.value) : above(changed.lo.value);
    if (!(room.lo <= room.hi)) return ranges;
    (end == End::Lo ? changed.lo : changed.hi).value = std::clamp(value, room.lo, room.hi);
    return replaced(ranges, range, changed);
}

double steppedEnd(const SortedStep& step, double from, End end, int by, double resolution) {
    const bool up = by > 0;
    const auto passed = std::visit(
        [&](const auto& values) { return valuePassed(values, from, end, up); }, step.values());
    if (!passed) return from;
    const double steps = roundedTo(from + by * resolution, resolution);
    return up ? std::max(steps, *passed) : std::min(steps, *passed);
}

RangeSet withMoved(const RangeSet& ranges, std::size_t range, double by) {
    assert(range < ranges.ranges().size());
    Range moved = ranges.ranges()[range];
    const double lo = timeseries::toDouble(moved.lo.value);
    const double hi = timeseries::toDouble(moved.hi.value);
    if (!isBounded(moved.lo) && !isBounded(moved.hi)) return ranges;
    if (!isBounded(moved.lo)) return withEnd(ranges, range, End::Hi, hi + by);
    if (!isBounded(moved.hi)) return withEnd(ranges, range, End::Lo, lo + by);
    constexpr double kMost = std::numeric_limits<double>::max();
    Room room = roomOf(ranges, range);
    room = {std::max(room.lo, -kMost), std::min(room.hi, kMost)};
    // The end in front is stopped; the other follows at its distance.
    const double width = hi - lo;
    if (by < 0) {
        moved.lo.value = std::max(lo + by, room.lo);
        moved.hi.value = std::min(std::get<double>(moved.lo.value) + width, room.hi);
    } else {
        moved.hi.value = std::min(hi + by, room.hi);
        moved.lo.value = std::max(std::get<double>(moved.hi.value) - width, room.lo);
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

std::size_t addLayer(Explorer& explorer, RangeSet ranges, const SortedStep& step) {
    assert(explorer.layers.size() + (explorer.sweep ? 1 : 0) < render::kMaxLayers);
    const auto isTaken = [&](const glm::dvec3& color) {
        const auto has = [&](const LayerChoice& layer) {
            const auto* rgb = layer.color ? std::get_if<glm::dvec3>(&*layer.color) : nullptr;
            return rgb != nullptr && *rgb == color;
        };
        return std::ranges::any_of(explorer.layers, has) ||
               (explorer.sweep && has(explorer.sweepLayer));
    };
    LayerChoice layer;
    layer.color = *std::ranges::find_if_not(kLayerColors, isTaken);
    layer.opacity = opacityFor(step.count(step.keptPart(ranges)));
    layer.ranges = std::move(ranges);
    explorer.layers.push_back(std::move(layer));
    return explorer.layers.size() - 1;
}

}  // namespace app
