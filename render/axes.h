// The opaque reference scene: the points' box and its axes with ticks, numbers and units.
#pragma once

#include "render/flat_mesh.h"
#include "render/lattice.h"
#include "render/view.h"

namespace render {

// Label and title sizes that suit a picture: legible in a small one, not loud in a large one. The
// font of axes and legend has both.
FontStyle labelStyle(glm::ivec2 pictureSize);
FontStyle titleStyle(glm::ivec2 pictureSize);

// Lines carry the window depth of what they show; labels stand at depth 0 and hide nothing. Edges
// are cut at the near plane and stand before ticks, six vertices a line.
struct AxesMeshes {
    FlatMesh behind;  // edges behind all that the box holds: drawn before the volume
    FlatMesh before;  // edges before it or on its outline, and ticks: drawn over it
    FlatMesh labels;
};
// Which edges carry the axes, and which ticks, is chosen from `midEye` (world), so that both eyes
// label the same ones. Labels lie inside the picture, outside the box, and apart from each other
// and from what `legend` draws; where there is no such place, they are left out. An axis that is
// nowhere on the box's outline (seen end on, or from inside) has none. REQUIRES: `font` has
// labelStyle(view.size).
AxesMeshes axesMeshes(const timeseries::Grid& grid, const Lattice& lattice, const View& view,
                      const glm::dvec3& midEye, const Font& font, const FlatMesh& legend = {});

}  // namespace render
