// What pixels have of a scene that is drawn by points, each by rays of its own: what the splatters
// sum for all pixels (render/model/footprint.h), in double, for some of them.
#pragma once

#include <atomic>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/together.h"

namespace render {

// The optical depth of all layers at each of these pixels, the mean of so many rays across each;
// row 0 is at the bottom. By more than one ray a splat is as small as a finer picture has it: one
// that is widened to be seen by a pixel's ray is not widened as much. Takes a pass over the points
// that the scene draws. Empty once it is not wanted any more. The same for any number of threads.
// REQUIRES: no scene.cells.
std::vector<double> splatDepthAt(const Scene& scene, const View& view,
                                 std::span<const glm::ivec2> pixels, int raysAcross,
                                 unsigned threads = sharingThreads(),
                                 const std::atomic<bool>& wanted = true);

}  // namespace render
