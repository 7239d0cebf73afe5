// What splats cost to draw. The unit is an ordinary splat: of kOrdinaryPixels pixels or fewer, of
// which much is spent on the splat itself. Larger ones cost by the pixels they touch.
// Pure.
#pragma once

#include "render/model/scene.h"
#include "render/points/view.h"

namespace render {

constexpr double kOrdinaryPixels = 256;

// Of one splat or cell of that layer, in the mean: estimated from a few of them, so it depends on
// view, footprint and the field, but costs nothing that grows with their number. At least 1.
double splatCost(const Scene& scene, std::size_t layer, const View& view);
// Of all that the layer, or the scene, draws in a view.
double layerCost(const Scene& scene, std::size_t layer, const View& view);
double sceneCost(const Scene& scene, const View& view);

}  // namespace render
