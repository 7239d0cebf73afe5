// Noise in a plane that is summed.
#pragma once

#include <gtest/gtest.h>

#include "render/model/scene.h"
#include "tests/support/scenes.h"

namespace tests {

// More points than are summed at once, in a picture whose rows do not divide evenly.
class NoisePlane : public testing::Test {
 protected:
    timeseries::SortedStep step_ = noise(cube(40));
    render::PlacedPoints placed_{step_.grid()};
    render::Scene scene_{.step = step_,
                         .placed = placed_,
                         .layers = {{step_.select(timeseries::RangeSet::parse("0.1:0.4,0.5:0.9")),
                                     {render::ByValue{{}, 0, 1}, 0.2}}},
                         .footprint = {},
                         .order = render::Order::None,
                         .clip = {}};
    render::View view_ = lookFrom({1, -3, 0.5}, {211, 157});
    std::vector<float> opaque_ = std::vector<float>(211 * 157, 1.0f);
};

}  // namespace tests
