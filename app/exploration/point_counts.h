// How many points of a step are selected, told while a range is dragged.
#pragma once

#include <cstdint>
#include <vector>

#include "app/choices/explorer.h"
#include "timeseries/index/sorted_step.h"

namespace app {

// Hidden layers count in `layers` only. With a clip box, the first two are of the points inside
// it.
struct PointCounts {
    std::vector<std::uint64_t> layers;  // in the order of Explorer::layers
    std::uint64_t selected = 0;         // in any visible layer, each once
    std::uint64_t kept = 0;
    std::uint64_t total = 0;  // valid, before anything was dropped
    bool inClipBox = false;   // there is one
    friend bool operator==(const PointCounts&, const PointCounts&) = default;
};

// Microseconds: binary searches only; with a clip box, a look at every selected point. A window
// stands at explorer.play.tick. REQUIRES: a resolved explorer. Throws OutsideKeptError when a layer
// asks for values that were dropped.
PointCounts pointCounts(const Explorer& explorer, const timeseries::SortedStep& step);

// The values whose points pictures and counts of this look at: those of every layer, of a sweep
// where it stands. REQUIRES: a resolved explorer.
timeseries::RangeSet rangesLookedAt(const Explorer& explorer);

}  // namespace app
