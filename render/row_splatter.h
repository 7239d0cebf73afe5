// Splats summed on the processor, a row of pixels after another: for drivers that draw there
// themselves, whose point sprites cost several times what their pixels do. The model of
// render/footprint.h in float.
#pragma once

#include <span>
#include <thread>
#include <vector>

#include "render/scene.h"
#include "render/view.h"

namespace render {

// What one layer of the scene adds up to: [y][x][1 or 4], row 0 at the bottom. `opaqueDepth` is the
// depth [0, 1] of the opaque scene a pixel, likewise: a splat whose centre lies behind it is not
// drawn there. Not a bit depends on the number of threads.
// REQUIRES: Weight or WeightedColor.
std::vector<float> sumRows(const Scene& scene, const View& view, Channels channels,
                           std::size_t layer, std::span<const float> opaqueDepth,
                           unsigned threads = std::thread::hardware_concurrency());

}  // namespace render
