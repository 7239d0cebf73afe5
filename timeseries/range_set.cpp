#include "timeseries/range_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace timeseries {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool holdsNothing(const Range& range) {
    const auto order = compare(range.lo.value, range.hi.value);
    if (order == std::partial_ordering::less) return false;
    return order != std::partial_ordering::equivalent || range.lo.open || range.hi.open;
}

bool startsBefore(const Range& a, const Range& b) {
    const auto order = compare(a.lo.value, b.lo.value);
    return order == std::partial_ordering::less ||
           (order == std::partial_ordering::equivalent && !a.lo.open && b.lo.open);
}

bool endsBefore(const Bound& a, const Bound& b) {
    const auto order = compare(a.value, b.value);
    return order == std::partial_ordering::less ||
           (order == std::partial_ordering::equivalent && a.open && !b.open);
}

// REQUIRES: b does not start before a.
bool overlapOrTouch(const Range& a, const Range& b) {
    const auto order = compare(b.lo.value, a.hi.value);
    return order == std::partial_ordering::less ||
           (order == std::partial_ordering::equivalent && !(b.lo.open && a.hi.open));
}

// Both ends of a range in a float type; see toInterval.
template <typename T>
bool floatInterval(const Range& range, Interval<T>& out) {
    constexpr T kMax = std::numeric_limits<T>::max(), kInf = std::numeric_limits<T>::infinity();
    const auto nearest = [](const Number& n, T above, T below, bool& beyond) {
        const double d = toDouble(n);
        beyond = std::isfinite(d) && std::abs(d) > static_cast<double>(kMax);
        if (beyond) return d > 0 ? above : below;
        // Integers go to T directly: a detour by double would round twice.
        return std::visit([](auto x) { return static_cast<T>(x); }, n);
    };
    bool beyond = false;
    T lo = nearest(range.lo.value, kInf, -kMax, beyond);
    if (range.lo.open && !beyond) lo = std::nextafter(lo, kInf);
    T hi = nearest(range.hi.value, kMax, -kInf, beyond);
    if (range.hi.open && !beyond) hi = std::nextafter(hi, -kInf);
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

template <typename T>
bool integerInterval(const Range& range, Interval<T>& out) {
    const auto nan = [](const Number& n) { return std::isnan(toDouble(n)); };
    if (nan(range.lo.value) || nan(range.hi.value)) return false;
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
    std::sort(ranges.begin(), ranges.end(), startsBefore);
    for (const Range& range : ranges) {
        if (ranges_.empty() || !overlapOrTouch(ranges_.back(), range)) {
            ranges_.push_back(range);
        } else if (endsBefore(ranges_.back().hi, range.hi)) {
            ranges_.back().hi = range.hi;
        }
    }
}

RangeSet RangeSet::everything() {
    return RangeSet(std::vector<Range>{{{-kInfinity}, {kInfinity}}});
}

template <typename T>
std::vector<Interval<T>> RangeSet::toIntervals() const {
    std::vector<Interval<T>> intervals;
    for (const Range& range : ranges_) {
        Interval<T> next;
        if (!toInterval(range, next)) continue;
        if (!intervals.empty() && adjacent(intervals.back(), next)) {
            intervals.back().hi = std::max(intervals.back().hi, next.hi);
        } else {
            intervals.push_back(next);
        }
    }
    return intervals;
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

RangeSet intersectionOf(const RangeSet& a, const RangeSet& b) {
    std::vector<Range> common;
    for (const Range& x : a.ranges()) {
        for (const Range& y : b.ranges()) {
            const Bound& lo = startsBefore(x, y) ? y.lo : x.lo;
            const Bound& hi = endsBefore(x.hi, y.hi) ? x.hi : y.hi;
            common.push_back({lo, hi});  // empty ones are dropped
        }
    }
    return RangeSet(std::move(common));
}

#define ISOCHRON_INSTANTIATE(T)                              \
    template bool toInterval<T>(const Range&, Interval<T>&); \
    template std::vector<Interval<T>> RangeSet::toIntervals<T>() const;
ISOCHRON_INSTANTIATE(std::uint8_t)
ISOCHRON_INSTANTIATE(std::int8_t)
ISOCHRON_INSTANTIATE(std::uint16_t)
ISOCHRON_INSTANTIATE(std::int16_t)
ISOCHRON_INSTANTIATE(std::uint32_t)
ISOCHRON_INSTANTIATE(std::int32_t)
ISOCHRON_INSTANTIATE(std::uint64_t)
ISOCHRON_INSTANTIATE(std::int64_t)
ISOCHRON_INSTANTIATE(float)
ISOCHRON_INSTANTIATE(double)
#undef ISOCHRON_INSTANTIATE

}  // namespace timeseries
