// What is typed into a layer's field.
#pragma once

#include <string_view>

#include "timeseries/index/sorted_step.h"

namespace app {

// A range text (RangeSet::parse), or quantiles of the step shown: "top 0.1 %", "bottom 5 %",
// "25 % : 75 %". A quantile selects at least that share of the kept points (to one part in 1e12:
// shares are decimal): its bound is the value of a point (nearest rank), so that equal values are
// never split. Outward, top and bottom have no bound but what was kept. Throws
// std::invalid_argument with one sentence that quotes the text.
timeseries::RangeSet parseSelection(std::string_view text, const timeseries::SortedStep& step);

}  // namespace app
