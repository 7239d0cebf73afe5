// What a user does to ranges and layers, as functions of plain values: a panel, a key and a script
// call the same. Exact numbers that were typed stay as typed; dragged ones are doubles.
#pragma once

#include <string_view>

#include "app/explorer.h"
#include "timeseries/sorted_step.h"

namespace app {

enum class End { Lo, Hi };

// REQUIRES of what follows: range < ranges.ranges().size().
// The end of a range dragged to a value: no farther than its other end, and it stops short of its
// neighbours (the nearest double beyond their ends), so that ranges never merge under the hand. An
// open end stays open; an unbounded one becomes closed.
timeseries::RangeSet withEnd(const timeseries::RangeSet& ranges, std::size_t range, End end,
                             double value);
// The whole range dragged by `by`, stopped by its neighbours; its width stays, to rounding.
// Unbounded ends stay.
timeseries::RangeSet withMoved(const timeseries::RangeSet& ranges, std::size_t range, double by);
timeseries::RangeSet without(const timeseries::RangeSet& ranges, std::size_t range);
timeseries::RangeSet with(const timeseries::RangeSet& ranges, const timeseries::Range& added);

// What is typed into a layer's field: a range text (RangeSet::parse), or quantiles of the step
// shown: "top 0.1 %", "bottom 5 %", "25 % : 75 %". A quantile selects at least that share of the
// kept points: its bound is the value of a point (nearest rank), so that equal values are never
// split. Throws std::invalid_argument with one sentence that quotes the text.
timeseries::RangeSet parseSelection(std::string_view text, const timeseries::SortedStep& step);

// A new layer, last; its colour is the next that no layer has (constant colours by place, as for
// several --range), its opacity that of a lump of so many points (opacityFor). Layers that were
// coloured by value stay so. Returns its place. REQUIRES: fewer than render::kMaxLayers layers, the
// swept one counted.
std::size_t addLayer(Explorer& explorer, timeseries::RangeSet ranges,
                     const timeseries::SortedStep& step);

// A value rounded to as few decimal digits as tell apart neighbours `resolution` (> 0) apart: what
// a drag across one pixel means.
double roundedTo(double value, double resolution);

}  // namespace app
