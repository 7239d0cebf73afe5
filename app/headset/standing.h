// Where things stand in the room before a hand moves them. Pure. Lengths in metres, in the stage
// (xr/pose.h).
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "render/points/placed_points.h"
#include "xr/pose.h"

namespace app::headset {

// The volume before the head, upright, its front towards the user: its longest side kVolumeWide
// long, its middle a little below the eye, so that it suits who sits and who stands, whatever the
// runtime knows of the floor. `boxHalfEdges`: PlacedPoints::boxHalfEdges().
inline constexpr double kVolumeWide = 0.6, kVolumeAhead = 0.85, kVolumeBelowEye = 0.25;
xr::Placement volumeBefore(const xr::Pose& head, const glm::dmat3& boxHalfEdges);
double firstSize(const glm::dmat3& boxHalfEdges);  // Placement::metresPerUnit of that

// A flat thing: x right, y up, z towards who looks at it; `half` its half width and height.
struct Plate {
    xr::Pose stageFromPlate;
    glm::dvec2 half{0.5};
};
inline constexpr glm::ivec2 kPanelPixels{1060, 1000};
inline constexpr double kPanelMetresPerPixel = 0.0008;
// The panel, left of the volume, turned to the head.
Plate panelBefore(const xr::Pose& head);
// Upright at a place, turned to the head.
Plate facingHead(const glm::dvec3& at, const xr::Pose& head, glm::dvec2 half);
// Above a hand, upright and turned to the head: a text.
Plate readoutNear(const xr::Pose& hand, const xr::Pose& head, glm::dvec2 half);

// The square from -1 to 1 (render::Placard) onto the plate, in the world of the volume.
glm::dmat4 worldFromPlacard(const Plate& plate, const xr::Placement& placement);

// Where a ray along -z of the pose meets the plate's face: (0, 0) its upper left corner, (1, 1) the
// lower right, and how far along. None beside it and from behind.
struct Hit {
    glm::dvec2 at;
    double distance;
};
std::optional<Hit> hitOf(const xr::Pose& ray, const Plate& plate);
// Of the volume's own coordinates (render/points/placed_points.h), in which its box is upright.
glm::dmat4 stageFromAxes(const xr::Placement& placement, const render::PlacedPoints& placed);
// Whether the ray meets the volume's box, or begins in it.
bool meetsBox(const xr::Pose& ray, const xr::Placement& placement, const glm::dmat3& boxHalfEdges);

}  // namespace app::headset
