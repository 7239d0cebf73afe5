// What the eye sees under the cursor where cells are drawn: a place between points.
#pragma once

#include "render/model/pick.h"

namespace render {

// Of what the ray of the window position (pixel coordinates, y up) passes in the scene's ranges, in
// exact parts of cells, the place at half of the light; and the point whose cell holds it.
// None where nothing is seen. Costs a look at each cell on the ray. Where layers are drawn by
// points beside those by cells, what is seen of either is looked for, and the nearer taken.
// REQUIRES: scene.cells.
std::optional<Picked> pickCell(const Scene& scene, const View& view, const glm::dvec2& window);

}  // namespace render
