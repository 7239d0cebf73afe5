// What a user does to the camera with a mouse, as functions of plain values. A view without a
// distance gets the one, the target and the shift that it has, so that nothing moves but by the
// hand.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "app/choices/explorer.h"
#include "render/points/placed_points.h"

namespace app {

// A picture as it is looked at: window positions below are its pixels, y down, (0, 0) the upper
// left corner.
struct Looking {
    render::Outline outline;  // PlacedPoints::outline()
    glm::ivec2 size;
    glm::dvec2 legend{0};  // legendOf() (camera.h)
};

// Dragged by so many pixels: half the picture's shorter side turns by 90 degrees. Elevation stays
// within +-90, azimuth in (-180, 180]; the box follows the hand.
ViewChoice orbited(ViewChoice view, glm::dvec2 pixels, const Looking& at);
// The target moves in the plane of the picture: what its plane shows under the cursor goes with it.
ViewChoice panned(ViewChoice view, glm::dvec2 pixels, const Looking& at);
// Distance times `factor`; what the target's plane shows under the cursor stays there. Distances
// stay within what --view takes.
ViewChoice zoomed(ViewChoice view, double factor, glm::dvec2 cursor, const Looking& at);
// All of the box, from where it is looked at.
ViewChoice fitted(ViewChoice view);

// A lamp above and left of who looks so.
LampChoice lampBeside(const ViewChoice& view);

// Looking along an axis, towards + or -: "from the right" is from +x.
enum class Side { Front, Back, Left, Right, Top, Bottom };
ViewChoice lookedFrom(ViewChoice view, Side side);

}  // namespace app
