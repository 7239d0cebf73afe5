// Which point is under the cursor: what the eye sees there. Pure.
#pragma once

#include <cstdint>
#include <optional>

#include "render/model/scene.h"
#include "render/points/view.h"

namespace render {

struct Picked {
    std::uint64_t point;  // position in the sorted step
    std::size_t layer;    // of the scene
    std::uint64_t gridIndex;
    glm::dvec3 world;
    double depth;  // view depth
};

// Of the splats whose footprint covers the window position (pixel coordinates, y up), the one at
// which the light summed from the eye passes half of the ray's. A splat's light is how opaque it
// is, less what stands before it, times how bright it is: the front of what is opaque, the middle
// of what is thin, and a bright column rather than the faint haze before it. Where an unordered
// picture mixes several colours nothing hides anything, and optical depth counts instead of
// opacity. None where the ray meets nothing that is seen. Costs a pass over the points that the
// scene draws, some 30 ns each.
std::optional<Picked> pick(const Scene& scene, const View& view, const glm::dvec2& window);

}  // namespace render
