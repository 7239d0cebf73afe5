// How many points have which value: of one step exactly, of steps seen before from what is
// remembered of them. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "timeseries/index/sorted_step.h"
#include "timeseries/series/series.h"

namespace app {

// How many infinite values stand at the ends of an axis from lo to hi: none at an end outside which
// finite ones lie.
struct AtInfinity {
    std::uint64_t below = 0, above = 0;
};
AtInfinity atInfinity(const timeseries::SortedStep& step, double lo, double hi);
AtInfinity atInfinity(const timeseries::StepSummary& summary, double lo, double hi);

// Kept points in each of `bins` equal parts of [lo, hi], ascending; each part but the last without
// its upper end. Those at infinity count in the outer parts. Two binary searches a bin. REQUIRES:
// lo < hi, both finite, bins >= 1.
std::vector<std::uint64_t> histogram(const timeseries::SortedStep& step, double lo, double hi,
                                     std::size_t bins);

// The histogram of a step that may have left memory: between its quantiles, points are taken as
// spread evenly; where quantiles are equal, the value has all their points.
std::vector<double> density(const timeseries::StepSummary& summary, double lo, double hi,
                            std::size_t bins);

// The numbers on an axis of counts from 0 to `most`, ascending, 0 first: round ones, or powers of
// ten where bars are as long as the logarithm of 1 + count. REQUIRES: most > 0.
std::vector<double> countTicks(double most, bool linear);
// "0", "250", "1k", "2.5M": as many digits as it takes, for counts that countTicks() gives.
std::string shortCount(double count);

}  // namespace app
