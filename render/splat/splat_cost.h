// What splats cost to draw, by the program or by GL. The unit is what a splat takes by itself; its
// pixels cost more, so many of them as much again (tests/bench/NOTES.md has what that was told
// from).
// Pure.
#pragma once

#include "render/model/scene.h"
#include "render/points/view.h"

namespace render {

enum class SummedBy { Program, Gl };
// In the program most of a pixel lies in its caches; a GPU blends floats, one or four of them.
constexpr double pixelsOfASplat(SummedBy by, Channels channels) {
    if (by == SummedBy::Program) return 200;
    return floatsPerPixel(channels) == 1 ? 30 : 8;
}

// Of one splat or cell of that layer, in the mean: estimated from a few of them, so it depends on
// view, footprint and the field, but costs nothing that grows with their number. At least 1.
double splatCost(const Scene& scene, std::size_t layer, const View& view,
                 SummedBy by = SummedBy::Program);
// Of all that the layer, or the scene, draws in a view.
double layerCost(const Scene& scene, std::size_t layer, const View& view,
                 SummedBy by = SummedBy::Program);
double sceneCost(const Scene& scene, const View& view, SummedBy by = SummedBy::Program);
// Beside it, of summing on the processor, what planes cost however little is drawn in them.
double planesCost(const Scene& scene, const View& view);

}  // namespace render
