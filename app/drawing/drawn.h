// What stands before the eyes: the step that was drawn last and how it lies in the world, which lag
// behind what an Exploration shows while the next step goes to the GPU.
#pragma once

#include <cstddef>
#include <memory>

#include "render/points/placed_points.h"
#include "timeseries/index/sorted_step.h"

namespace app {

struct Drawn {
    const render::PlacedPoints* placed;  // not null; of the step's grid
    std::shared_ptr<const timeseries::SortedStep> sorted;
    std::size_t step = 0;
};

}  // namespace app
