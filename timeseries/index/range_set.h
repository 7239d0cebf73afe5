// What is selected: ranges of values, with open or closed ends, in exact numbers.
//
// A RangeSet knows no data type. toIntervals<T> turns it, once, into closed intervals of a field's
// own type T; from there a selection is nothing but lo <= v && v <= hi in T. Rounding comes before
// the union: a set holds in T what any of its ranges holds there.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/index/number.h"

namespace timeseries {

constexpr double kInfinity = std::numeric_limits<double>::infinity();  // the end of an open range

struct Bound {
    Number value;
    bool open = false;
};

struct Range {
    Bound lo, hi;
};

// Closed, lo <= hi, no NaN.
template <typename T>
struct Interval {
    T lo, hi;
    friend bool operator==(const Interval&, const Interval&) = default;
};

constexpr Interval<double> kAllNumbers{-kInfinity, kInfinity};

// The range in the type T; false when it holds no value of T.
// Float types: each bound goes to the nearest T, then an open end steps one T inward; a finite
// bound beyond T's largest finite value by half a step stays outside it (lo becomes +inf, hi the
// largest finite value). Integer types: each bound goes inward to an integer, an open integral
// bound one further; what lies beyond T's limits saturates. A NaN bound holds nothing.
template <typename T>
bool toInterval(const Range& range, Interval<T>& out);

// A range text that cannot be read. what() is one sentence that quotes the text.
struct RangeSyntaxError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

// Ascending. What overlaps or touches is one range, [1,2) with [2,3], where that is so in every
// type: [1,2) and (2,3] are two, and so are [1,2.5) and [2,2.4999999999], of which float rounds
// 2.5 out of the first and into the second.
class RangeSet {
 public:
    RangeSet() = default;
    // Sorts, merges, drops what is empty (lo > hi, NaN, lo = hi with an open end).
    explicit RangeSet(std::vector<Range> ranges);

    static RangeSet everything();

    // "lo:hi" closed; "[lo,hi)" and "lo:hi" with brackets for open ends, the separator being ':'
    // or, inside brackets, ','; "lo to hi"; "c~d" or "c ± d" for [c-d, c+d]; "> v", ">= v", "< v",
    // "<= v"; "min" and "max" for unbounded ends; a lone number for [v, v]; commas between ranges.
    // Whole numbers without '.', 'e' or 'inf' stay such, from 2^53 on with zeros behind a point,
    // too; other fractions are refused there. Throws RangeSyntaxError, also for lo > hi, NaN, a
    // negative d, text without a range, and what may be a decimal comma ("600,5:700").
    static RangeSet parse(std::string_view text);

    // Text that parses back to the same set; "" when empty.
    std::string text() const;

    std::span<const Range> ranges() const { return ranges_; }
    bool empty() const { return ranges_.empty(); }

    // Ascending; disjoint and not adjacent in T (no value of T lies between two that were merged).
    template <typename T>
    std::vector<Interval<T>> toIntervals() const;

    friend bool operator==(const RangeSet&, const RangeSet&);

 private:
    std::vector<Range> ranges_;
};

RangeSet unionOf(std::span<const RangeSet> sets);

}  // namespace timeseries
