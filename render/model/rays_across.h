// How finely a picture looks at cells that are small in it.
#pragma once

#include <glm/vec2.hpp>

#include "render/model/scene.h"
#include "render/points/view.h"

namespace render {

// The pixels that a cell as large as a cube of the unit length covers, seen along an axis in the
// middle of the box, or no farther away than the near plane.
double cellPixels(const Scene& scene, const View& view);

// So many rays across a pixel, and as many above each other, have the mean that the pixel shows: as
// many as leave kRaysACell on a side of such a cell. A ray takes of a cell what a pixel's width of
// the field about it has, so that fewer would spread a thin range beyond the cell that has it, and
// count it there again; and cells between them would be missed. A coarse pixel has as many as one
// of the picture's: it blurs more than fewer rays lose (tests/bench/NOTES.md).
int raysAcross(const Scene& scene, const View& view);
inline constexpr double kRaysACell = 3;
inline constexpr int kMostRaysAcross = 8;

}  // namespace render
