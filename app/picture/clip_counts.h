// How many of some points lie inside a clip box.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/points/placed_points.h"
#include "timeseries/index/sorted_step.h"

namespace app {

// Of each set of runs the points inside the box, exactly: every point is looked at, about a
// nanosecond each on one thread and once also where sets share it. Runs of a set are disjoint and
// ascending, as SortedStep::select() gives them.
std::vector<std::uint64_t> countsInside(const timeseries::SortedStep& step,
                                        const render::IndexBox& box,
                                        std::span<const std::vector<timeseries::Run>> sets);

}  // namespace app
