// Which point is under the cursor: what the eye sees there. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "render/model/scene.h"
#include "render/points/view.h"

namespace render {

// A point, or the one nearest to a place between points.
struct Picked {
    std::size_t layer;  // of the scene
    std::uint64_t gridIndex;
    timeseries::Number value;
    glm::dvec3 world;                 // of the point
    double depth;                     // view depth, of what is seen
    std::optional<double> between{};  // the interpolated value that is seen, where cells are
};

// What a ray meets of a scene.
struct Met {
    std::size_t layer;
    double depth, opticalDepth, value;
};
// Of what it meets, the nearest first, that at which the light summed from the eye passes half of
// the ray's: its place. A piece's light is how opaque it is, less what stands before it, times how
// bright it is: the front of what is opaque, the middle of what is thin, and a bright column rather
// than the faint haze before it. Where an unordered picture mixes several colours nothing hides
// anything, and optical depth counts instead of opacity. None where nothing is seen.
struct HalfOfLight {
    std::size_t at;  // among what is met
    double share;    // of its optical depth, [0, 1]: where in it, if it is the same all through
};
std::optional<HalfOfLight> atHalfOfLight(const Scene& scene, std::span<const Met> met);

// The view depth from which on a globe's Earth hides what a window position shows; infinity where
// it hides nothing.
double depthOfBall(const PlacedPoints& placed, const View& view, const glm::dvec2& window);

// Of the splats whose footprint covers the window position (pixel coordinates, y up), the one at
// half of the light. None where the ray meets nothing that is seen. Costs a pass over the points
// that the scene draws, some 30 ns each. Of cells: render/reference/cell_pick.h.
std::optional<Picked> pick(const Scene& scene, const View& view, const glm::dvec2& window);

}  // namespace render
