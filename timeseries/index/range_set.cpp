#include "timeseries/index/range_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "timeseries/grid/with_type.h"

namespace timeseries {
namespace {

bool holdsNothing(const Range& range) {
    const auto order = compare(range.lo.value, range.hi.value);
    if (order == std::partial_ordering::less) return false;
    return order != std::partial_ordering::equivalent || range.lo.open || range.hi.open;
}

// By the low ends, of the same ones by the high ends.
bool comesBefore(const Range& a, const Range& b) {
    const auto lo = compare(a.lo.value, b.lo.value);
    if (lo != std::partial_ordering::equivalent) return lo == std::partial_ordering::less;
    if (a.lo.open != b.lo.open) return b.lo.open;
    const auto hi = compare(a.hi.value, b.hi.value);
    if (hi != std::partial_ordering::equivalent) return hi == std::partial_ordering::less;
    return a.hi.open && !b.hi.open;
}

template <typename T>
T nearestFloat(const Number& number) {
    const double d = toDouble(number);
    if (std::isfinite(d) && std::abs(d) > static_cast<double>(std::numeric_limits<T>::max()))
        return timeseries::nearestFloat<T>(d);
    // Integers go to T directly: a detour by double would round twice.
    return std::visit([](auto x) { return static_cast<T>(x); }, number);
}

// a < b, and no type rounds them to one value.
bool apart(const Number& a, const Number& b) {
    return nearestFloat<float>(a) < nearestFloat<float>(b) &&
           nearestFloat<double>(a) < nearestFloat<double>(b);
}

// What follows holds in every type, not of the exact numbers alone: of two bounds that are rounded
// to one value, an open one lies inside a closed one, however they stand to each other.

bool startsFirst(const Bound& a, const Bound& b) {
    return compare(a.value, b.value) <= 0 && (!a.open || b.open || apart(a.value, b.value));
}

bool endsLast(const Bound& a, const Bound& b) {
    return compare(a.value, b.value) >= 0 && (!a.open || b.open || apart(b.value, a.value));
}

// Nothing lies between the end of one range and the begin of another.
bool reaches(const Bound& end, const Bound& begin) {
    return compare(begin.value, end.value) <= 0 &&
           (!end.open || !begin.open || apart(begin.value, end.value));
}

// The one range that holds in every type what a or b holds there; nothing where there is none.
std::optional<Range> joined(const Range& a, const Range& b) {
    if (!reaches(a.hi, b.lo) || !reaches(b.hi, a.lo)) return std::nullopt;
    const Bound *lo = nullptr, *hi = nullptr;
    for (const Range* each : {&a, &b}) {
        if (startsFirst(each->lo, a.lo) && startsFirst(each->lo, b.lo)) lo = &each->lo;
        if (endsLast(each->hi, a.hi) && endsLast(each->hi, b.hi)) hi = &each->hi;
    }
    if (!lo || !hi) return std::nullopt;
    return Range{*lo, *hi};
}

// Both ends of a range in a float type; see toInterval.
template <typename T>
bool floatInterval(const Range& range, Interval<T>& out) {
    constexpr T kMax = std::numeric_limits<T>::max(), kInf = std::numeric_limits<T>::infinity();
    const auto isBeyond = [](const Number& number) {
        return std::isinf(nearestFloat<T>(number)) && std::isfinite(toDouble(number));
    };
    T lo = nearestFloat<T>(range.lo.value), hi = nearestFloat<T>(range.hi.value);
    if (isBeyond(range.lo.value))
        lo = std::max(lo, -kMax);
    else if (range.lo.open)
        lo = std::nextafter(lo, kInf);
    if (isBeyond(range.hi.value))
        hi = std::min(hi, kMax);
    else if (range.hi.open)
        hi = std::nextafter(hi, -kInf);
    out = {lo, hi};
    return lo <= hi;  // false for NaN
}

// __int128 holds every int64, every uint64, and their neighbours.
using Wide = __int128;

// The least integer at or above the bound (above it when open); mirrored for the high end by the
// caller. Doubles are clamped to +-2^65, far outside every 64-bit type.
Wide ceiling(const Number& value, bool open) {
    if (const auto* d = std::get_if<double>(&value)) {
        constexpr double kFar = 36893488147419103232.0;  // 2^65
        const double clamped = std::clamp(*d, -kFar, kFar);
        const double up = std::ceil(clamped);
        return static_cast<Wide>(up) + (open && up == clamped ? 1 : 0);
    }
    const Wide whole = std::visit([](auto x) { return static_cast<Wide>(x); }, value);
    return whole + (open ? 1 : 0);
}

Wide floorOf(const Number& value, bool open) {
    if (const auto* d = std::get_if<double>(&value)) return -ceiling(Number(-*d), open);
    const Wide whole = std::visit([](auto x) { return static_cast<Wide>(x); }, value);
    return whole - (open ? 1 : 0);
}

// REQUIRES: no NaN.
template <typename T>
bool integerInterval(const Range& range, Interval<T>& out) {
    const Wide lowest = std::numeric_limits<T>::min(), highest = std::numeric_limits<T>::max();
    const Wide lo = std::max(ceiling(range.lo.value, range.lo.open), lowest);
    const Wide hi = std::min(floorOf(range.hi.value, range.hi.open), highest);
    if (lo > hi) return false;
    out = {static_cast<T>(lo), static_cast<T>(hi)};
    return true;
}

// No value of T lies between a and b. REQUIRES: a.hi and b.lo ascend.
template <typename T>
bool adjacent(const Interval<T>& a, const Interval<T>& b) {
    if (b.lo <= a.hi) return true;
    if constexpr (std::is_floating_point_v<T>) {
        return b.lo <= std::nextafter(a.hi, std::numeric_limits<T>::infinity());
    } else {
        return b.lo == static_cast<T>(a.hi + 1);
    }
}

}  // namespace

template <typename T>
bool toInterval(const Range& range, Interval<T>& out) {
    if (holdsNothing(range)) return false;
    if constexpr (std::is_floating_point_v<T>) {
        return floatInterval(range, out);
    } else {
        return integerInterval(range, out);
    }
}

RangeSet::RangeSet(std::vector<Range> ranges) {
    std::erase_if(ranges, holdsNothing);
    std::sort(ranges.begin(), ranges.end(), comesBefore);
    for (Range& range : ranges) {
        // What it grew to may join those that it did not.
        for (std::size_t i = ranges_.size(); i-- > 0;) {
            const auto both = joined(ranges_[i], range);
            if (!both) continue;
            range = *both;
            ranges_.erase(ranges_.begin() + static_cast<std::ptrdiff_t>(i));
            i = ranges_.size();
        }
        ranges_.insert(std::ranges::upper_bound(ranges_, range, comesBefore), range);
    }
}

RangeSet RangeSet::everything() {
    return RangeSet(std::vector<Range>{{{-kInfinity}, {kInfinity}}});
}

template <typename T>
std::vector<Interval<T>> RangeSet::toIntervals() const {
    std::vector<Interval<T>> all, merged;
    for (const Range& range : ranges_)
        if (Interval<T> next; toInterval(range, next)) all.push_back(next);
    // The order of the rounded bounds may be another than that of the exact ones.
    std::ranges::sort(all, {}, &Interval<T>::lo);
    for (const Interval<T>& next : all) {
        if (!merged.empty() && adjacent(merged.back(), next))
            merged.back().hi = std::max(merged.back().hi, next.hi);
        else
            merged.push_back(next);
    }
    return merged;
}

bool operator==(const RangeSet& a, const RangeSet& b) {
    const auto same = [](const Bound& x, const Bound& y) {
        return x.open == y.open && compare(x.value, y.value) == std::partial_ordering::equivalent;
    };
    return std::ranges::equal(a.ranges_, b.ranges_, [&](const Range& x, const Range& y) {
        return same(x.lo, y.lo) && same(x.hi, y.hi);
    });
}

RangeSet unionOf(std::span<const RangeSet> sets) {
    std::vector<Range> all;
    for (const RangeSet& set : sets)
        all.insert(all.end(), set.ranges().begin(), set.ranges().end());
    return RangeSet(std::move(all));
}

#define ISOCHRON_INSTANTIATE(T)                              \
    template bool toInterval<T>(const Range&, Interval<T>&); \
    template std::vector<Interval<T>> RangeSet::toIntervals<T>() const;
ISOCHRON_EACH_TYPE(ISOCHRON_INSTANTIATE)
#undef ISOCHRON_INSTANTIATE

}  // namespace timeseries
