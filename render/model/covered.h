// Where in a picture a scene's splats may be. Pure; never too small.
#pragma once

#include <glm/vec2.hpp>

#include "render/model/footprint.h"

namespace render {

// How far, in pixels from its centre, any footprint of the scene reaches in this view; infinite
// when the eye is among the points.
double farthestReach(const Scene& scene, const PointsView& view);

struct PixelBox {
    glm::ivec2 at{0}, size{0};  // lower left corner; nothing when either side is 0
    friend bool operator==(const PixelBox&, const PixelBox&) = default;
};
// Holds every pixel of the picture that a splat of the scene may touch.
PixelBox coveredPixels(const Scene& scene, const View& view);

}  // namespace render
