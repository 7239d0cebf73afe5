// How many points have which value: of one step exactly, of steps seen before from what is
// remembered of them. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "timeseries/series.h"
#include "timeseries/sorted_step.h"

namespace app {

// Kept points in each of `bins` equal parts of [lo, hi], ascending; each part but the last without
// its upper end. Two binary searches a bin. REQUIRES: lo < hi, both finite, bins >= 1.
std::vector<std::uint64_t> histogram(const timeseries::SortedStep& step, double lo, double hi,
                                     std::size_t bins);

// The same of a step that may have left memory: between its quantiles, points are taken as spread
// evenly; where quantiles are equal, the value has all their points.
std::vector<double> density(const timeseries::StepSummary& summary, double lo, double hi,
                            std::size_t bins);

}  // namespace app
