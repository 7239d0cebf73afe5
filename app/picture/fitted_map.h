// Colour maps that span the ranges of their layers go on to do so while these are edited.
#pragma once

#include <optional>
#include <span>

#include "app/choices/explorer.h"
#include "app/choices/first_choice.h"
#include "timeseries/index/sorted_step.h"

namespace app {

// Of layers whose ranges are others than in `now`, and whose maps are not: a map whose ends are
// what the program itself gives such a layer, the range's own or darkEnds(), as they were in
// `before`, which the edit began from, gets those of the new ranges. Any other stays. `seen`: ends
// of the data, those of the step shown first.
void refitMaps(Explorer& next, const Explorer& now, const Explorer& before,
               std::span<const Extent> seen);

// Where the data began that the program's own map of a range without a lower end was fitted to:
// such a map's dark end lies below all of them. None of a map that begins elsewhere for all that
// can be told.
std::optional<double> darkMapsData(const Extent& map, const timeseries::RangeSet& ranges,
                                   const timeseries::SortedStep& step);

}  // namespace app
