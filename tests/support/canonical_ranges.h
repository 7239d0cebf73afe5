// What a RangeSet's ranges are like.
#pragma once

#include <compare>
#include <limits>
#include <span>

#include "tests/support/selection_oracle.h"
#include "timeseries/index/range_set.h"

namespace oracle {

// Two numbers that some type rounds to one, or that lie beyond all floats.
inline bool roundTogether(const timeseries::Number& a, const timeseries::Number& b) {
    const Real x = oracle::real(a), y = oracle::real(b), most = std::numeric_limits<float>::max();
    if (x == y) return false;
    return static_cast<float>(x) == static_cast<float>(y) ||
           static_cast<double>(x) == static_cast<double>(y) || (x > most && y > most) ||
           (x < -most && y < -most);
}

// None empty, ascending; disjoint and not touching, but for ranges that are another union where
// their bounds are rounded.
inline bool canonical(std::span<const timeseries::Range> ranges) {
    for (const timeseries::Range& range : ranges) {
        const auto order = timeseries::compare(range.lo.value, range.hi.value);
        if (order == std::partial_ordering::unordered || order > 0) return false;
        if (order == 0 && (range.lo.open || range.hi.open)) return false;
    }
    for (std::size_t i = 1; i < ranges.size(); ++i) {
        if (timeseries::compare(ranges[i - 1].lo.value, ranges[i].lo.value) > 0) return false;
        for (std::size_t j = 0; j < i; ++j) {
            const timeseries::Range &a = ranges[j], &b = ranges[i];
            const auto order = timeseries::compare(a.hi.value, b.lo.value);
            if (order < 0 || (order == 0 && a.hi.open && b.lo.open)) continue;
            bool excused = false;
            for (const timeseries::Bound& x : {a.lo, a.hi})
                for (const timeseries::Bound& y : {b.lo, b.hi})
                    excused = excused || roundTogether(x.value, y.value);
            if (!excused) return false;
        }
    }
    return true;
}

}  // namespace oracle
