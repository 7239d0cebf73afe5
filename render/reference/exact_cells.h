// Planes of a scene that is drawn by cells, as the truth has them: the interval volume itself
// (render/reference/interval_truth.h), by rays.
#pragma once

#include <cstddef>
#include <memory>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/splat/splatter.h"
#include "render/splat/targets.h"

namespace render {

// Of each pixel the mean of so many rays across; of Count, of the ray in its middle, the cells.
inline constexpr int kExactRays = 4;

// All of the plane at its first call. View and targets must outlive it, as the scene. REQUIRES:
// scene.cells, of all layers.
std::unique_ptr<PlaneSum> exactCellPlane(const Scene& scene, const View& view, Channels channels,
                                         std::size_t layer, Targets& targets);

}  // namespace render
