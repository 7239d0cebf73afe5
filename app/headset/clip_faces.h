// The clip box as hands see it: an upright box in axis coordinates (render/points/placed_points.h),
// however oblique it stands in the room, and which of its faces a hand is at. Pure.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/choices/explorer.h"
#include "render/points/placed_points.h"
#include "xr/pose.h"

namespace app::headset {

struct AxisBox {
    glm::dvec3 lo, hi;  // lo <= hi
};
struct Face {
    int axis;  // that it stands across
    int side;  // -1: at lo, 1: at hi
    friend bool operator==(const Face&, const Face&) = default;
};

// Where a line is in a box, as multiples of `along`; it may begin behind `from`.
struct Crossing {
    double enters, leaves;
    Face in, out;
};
std::optional<Crossing> crossing(const glm::dvec3& from, const glm::dvec3& along,
                                 const AxisBox& box);

// What of the points' box is inside the clip box: all of it without one.
AxisBox clippedBox(const render::PlacedPoints& placed, const std::optional<ClipBox>& clip);

// A face that a hand can take hold of, and where, in the stage.
struct Hold {
    Face face;
    glm::dvec3 at;
};
// The face nearest to the tip (the aim pose's place), where one is within kReach; else the first
// that the ray along -z meets, also from inside. Faces across a flat axis cannot be moved.
inline constexpr double kReach = 0.08;  // metres
// The first of these alone: `place` is where the tip is among the box's coordinates, which
// `inStage` leads back from.
std::optional<Hold> nearestFace(const glm::dvec3& tip, const glm::dvec3& place, const AxisBox& box,
                                const glm::bvec3& canMove,
                                const std::function<glm::dvec3(const glm::dvec3&)>& inStage);
std::optional<Hold> holdOf(const xr::Pose& aim, const glm::dmat4& stageFromAxes, const AxisBox& box,
                           const glm::dvec3& boxHalf);

}  // namespace app::headset
