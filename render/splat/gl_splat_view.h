// What shaders know of a scene's points and of the view that they are seen in.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "render/model/footprint.h"
#include "render/model/scene.h"
#include "render/points/view.h"

namespace render {

// GLSL mirror: SplatView in shaders/splat_points.glsl.
struct SplatViewBlock {
    glm::mat4 viewFromAxes;
    glm::vec4 rayAxis, perPixelX, perPixelY, window, depths, kernel, slopeAndLengths;
    glm::vec4 domainLo, domainHi, boxHalf;
    glm::vec4 meshScale, meshOffset, meshFrom, meshTo;
    glm::uvec4 placed, clipLo, clipHi;
};

// Where the points lie and which of them the clip box holds, and nothing of a view.
SplatViewBlock pointsBlock(const Scene& scene);
// `guard`: how far the viewport reaches beyond the picture, in pixels.
SplatViewBlock viewBlock(const Scene& scene, const View& view, const PointsView& seen, int guard);

}  // namespace render
