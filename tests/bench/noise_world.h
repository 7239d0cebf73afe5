// As many splats as wanted, as an Exploration shows them.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/support/shown_steps.h"

namespace bench {

// n^3 points of noise of which `count` are selected, by one colour.
inline tests::ShownSteps noiseWorld(std::size_t n, std::uint64_t count) {
    tests::ShownSteps shown(n, 1);
    const double share = static_cast<double>(count) / std::pow(static_cast<double>(n), 3);
    shown.explorer.layers = {tests::ShownSteps::layer("0:1", glm::dvec3(1, 0.5, 0))};
    shown.explorer.layers[0].ranges =
        timeseries::RangeSet(std::vector{timeseries::Range{{0.4}, {0.4 + share}}});
    return shown;
}

}  // namespace bench
