// The opaque reference scene: the points' box and its axes with ticks, numbers and units.
#pragma once

#include "render/annotate/box_edges.h"
#include "render/annotate/flat_mesh.h"
#include "render/points/placed_points.h"
#include "render/points/view.h"

namespace render {

// Label and title sizes that suit a picture: legible in a small one, not loud in a large one. The
// font of axes and legend has both.
FontStyle labelStyle(glm::ivec2 pictureSize);
FontStyle titleStyle(glm::ivec2 pictureSize);

// All carry the window depth of what they show or stand beside. Edges are cut at the near plane and
// stand before ticks, six vertices a line; where a text stands, lines are left out.
struct AxesMeshes {
    // Coastlines and lines of longitude and latitude (render/annotate/map_lines.h), which let
    // through what lies behind them: one of both, the other is empty.
    FlatMesh mapBehind, mapBefore;
    // Edges behind all that the box holds, and a globe's Earth: drawn before the volume.
    FlatMesh behind;
    FlatMesh before;   // edges before it or on its outline, and ticks: drawn over it
    FlatMesh grounds;  // of the labels
    FlatMesh labels;
};
// Labels lie inside the picture, apart from each other and from the ground of `legend`: render/
// axis_labels.h has the rules. All is chosen for the middle (world), so that both eyes have the
// same labels. REQUIRES: `font` has labelStyle(view.size).
AxesMeshes axesMeshes(const timeseries::Grid& grid, const PlacedPoints& placed, const View& view,
                      const Middle& middle, const Font& font, const FlatMesh& legend = {},
                      const glm::dvec3& background = glm::dvec3(0));

}  // namespace render
