// Ranges of values and of places as a picture words them.
#pragma once

#include <string>

#include "app/choices/explorer.h"
#include "timeseries/grid/grid.h"
#include "timeseries/readers/reader.h"

namespace app {

// "600 to 1600 K", "≥ 600 K", "all values"; "≈ 0.3333333 to 1 K" where doubles were rounded.
std::string rangeLabel(const timeseries::RangeSet& ranges, const std::string& units);

// "ice, lake": what the file calls the values in the ranges; "" of more than a few, or of none.
std::string classLabel(const timeseries::RangeSet& ranges, const timeseries::Variable& variable);

// Where the swept window stands, in as many digits as its width needs: "1426.5 ± 40".
std::string sweptText(const timeseries::ValueSweep& sweep, std::int64_t tick);

// "lon −20 to 40 °E, depth ≥ 100 m": of the axes along which the box cuts; "" where it cuts
// nothing.
std::string clipLabel(const ClipBox& clip, const timeseries::Grid& grid);

}  // namespace app
