// What splats cost to draw. The unit is what a splat takes by itself; its pixels cost more, so many
// of them as much again (tests/bench/NOTES.md has what that was told from).
// Pure.
#pragma once

#include "render/model/scene.h"
#include "render/points/view.h"

namespace render {

constexpr double kPixelsOfASplat = 200;

// Of one splat or cell of that layer, in the mean: estimated from a few of them, so it depends on
// view, footprint and the field, but costs nothing that grows with their number. At least 1.
double splatCost(const Scene& scene, std::size_t layer, const View& view);
// Of all that the layer, or the scene, draws in a view.
double layerCost(const Scene& scene, std::size_t layer, const View& view);
double sceneCost(const Scene& scene, const View& view);
// Beside it, of summing on the processor, what planes cost however little is drawn in them.
double planesCost(const Scene& scene, const View& view);

}  // namespace render
