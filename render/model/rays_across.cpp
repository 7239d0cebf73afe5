#include "render/model/rays_across.h"

#include <algorithm>
#include <cmath>

#include "render/model/footprint.h"

namespace render {

double cellPixels(const Scene& scene, const View& view) {
    const PointsView seen(scene.placed, view);
    const double across = scene.placed.unitLength() / seen.rayLength;
    const glm::dvec3 middle(view.viewFromWorld * glm::dvec4(0, 0, 0, 1));
    const double depth = std::max(-middle.z, seen.rays.near);
    return across * across * seen.rays.focal.x * seen.rays.focal.y / (depth * depth);
}

int raysAcross(const Scene& scene, const View& view) {
    const double rays = std::ceil(kRaysACell / view.across / std::sqrt(cellPixels(scene, view)));
    // So that a picture's rays have 16 bits along each side (render/splat/seen_splat.h).
    const int most = std::min(kMostRaysAcross, 65535 / std::max({view.size.x, view.size.y, 1}));
    return static_cast<int>(std::clamp<double>(rays, 1, std::max(most, 1)));
}

}  // namespace render
