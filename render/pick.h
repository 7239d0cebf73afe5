// Which point is under the cursor: what the eye sees there. Pure.
#pragma once

#include <cstdint>
#include <optional>

#include "render/scene.h"
#include "render/view.h"

namespace render {

struct Picked {
    std::uint64_t point;  // position in the sorted step
    std::size_t layer;    // of the scene
    std::uint64_t gridIndex;
    glm::dvec3 world;
    double depth;  // view depth
};

// Of the splats whose footprint covers the window position (pixel coordinates, y up), the one at
// which the optical depth summed from the eye passes half of the ray's, at most 0.5: the front of
// what is opaque, the middle of what is thin. None where the ray meets nothing that is seen. Costs
// a pass over the points that the scene draws, some 30 ns each.
std::optional<Picked> pick(const Scene& scene, const View& view, const glm::dvec2& window);

}  // namespace render
