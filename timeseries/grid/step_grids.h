// How the grids of a variable's steps are to each other, as far as a reader tells it without
// reading all of them: of many files, by the first, one in the middle and the last.
#pragma once

#include <cstdint>

#include "timeseries/grid/grid.h"

namespace timeseries {

struct StepGrids {
    enum class Are {
        One,    // all steps have the same
        Moved,  // the same points, joined alike, lie elsewhere
        Own     // each step has points of its own
    };
    Are are = Are::One;
    // Of Own: how many points a step has, where that is known of all; else 0.
    std::uint64_t least = 0, most = 0;
};

// What the second is to the first.
StepGrids::Are heldAgainst(const Grid& first, const Grid& other);

}  // namespace timeseries
