// Steps as tests of layers and pictures draw them: in memory or, where the environment has
// ISOCHRON_TESTS_FROM_STORE, from a file, of which there is nothing else.
#pragma once

#include <cstdlib>

#include "tests/support/step_bytes.h"

namespace tests {

inline timeseries::SortedStep sorted(
    const timeseries::Field& field,
    const timeseries::RangeSet& kept = timeseries::RangeSet::everything()) {
    static const bool fromStore = std::getenv("ISOCHRON_TESTS_FROM_STORE") != nullptr;
    timeseries::SortedStep step = timeseries::SortedStep::build(field, kept);
    // Nothing is written of points that were dropped, or of none.
    if (!fromStore || step.size() == 0 || kept != timeseries::RangeSet::everything()) return step;
    return timeseries::SortedStep::ofFile(opened(written(step)), field.grid, field.categories);
}

}  // namespace tests
