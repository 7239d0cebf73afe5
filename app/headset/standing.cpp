#include "app/headset/standing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "app/headset/clip_faces.h"

namespace app::headset {
namespace {

constexpr glm::dvec3 kUp(0, 1, 0);
constexpr double kPanelAhead = 1.1, kPanelAside = 0.65;  // radians to the left
constexpr double kPanelBelowEye = 0.1;
constexpr double kReadoutAbove = 0.09;

// The turn about the vertical that a head has, also of one that looks straight up or down.
glm::dquat heading(const xr::Pose& head) {
    const glm::dvec3 forward = head.orientation * glm::dvec3(0, 0, -1);
    const glm::dvec3 up = head.orientation * kUp;
    const glm::dvec3 level = std::hypot(forward.x, forward.z) > 0.1 ? forward
                             : forward.y > 0                        ? -up
                                                                    : up;
    return glm::angleAxis(std::atan2(-level.x, -level.z), kUp);
}

// Upright, z towards the eye.
glm::dquat facing(const glm::dvec3& from, const glm::dvec3& eye) {
    const glm::dvec3 z = glm::normalize(eye - from);
    const glm::dvec3 x = glm::normalize(glm::cross(kUp, z));
    return glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z));
}

}  // namespace

double firstSize(const glm::dmat3& boxHalfEdges) {
    const double longest = std::max({glm::length(boxHalfEdges[0]), glm::length(boxHalfEdges[1]),
                                     glm::length(boxHalfEdges[2]), 1e-3});
    return 0.5 * kVolumeWide / longest;
}

xr::Placement volumeBefore(const xr::Pose& head, const glm::dmat3& boxHalfEdges) {
    // z up -> y up.
    const glm::dquat upright = glm::angleAxis(-std::numbers::pi / 2, glm::dvec3(1, 0, 0));
    const glm::dquat turn = heading(head);
    return {{turn * upright, head.position + turn * glm::dvec3(0, -kVolumeBelowEye, -kVolumeAhead)},
            firstSize(boxHalfEdges)};
}

Plate panelBefore(const xr::Pose& head) {
    const glm::dquat turn = heading(head) * glm::angleAxis(kPanelAside, kUp);
    const glm::dvec3 at = head.position + turn * glm::dvec3(0, -kPanelBelowEye, -kPanelAhead);
    return {{facing(at, head.position), at}, 0.5 * kPanelMetresPerPixel * glm::dvec2(kPanelPixels)};
}

Plate facingHead(const glm::dvec3& at, const xr::Pose& head, glm::dvec2 half) {
    const glm::dvec3 towards = head.position - at;
    const bool isAbove = std::hypot(towards.x, towards.z) < 1e-3;
    return {{isAbove ? heading(head) : facing(at, head.position), at}, half};
}

Plate readoutNear(const xr::Pose& hand, const xr::Pose& head, glm::dvec2 half) {
    return facingHead(hand.position + (kReadoutAbove + half.y) * kUp, head, half);
}

glm::dmat4 worldFromPlacard(const Plate& plate, const xr::Placement& placement) {
    return glm::inverse(xr::stageFromWorld(placement)) *
           glm::scale(xr::matrix(plate.stageFromPlate), glm::dvec3(plate.half, 1));
}

std::optional<Hit> hitOf(const xr::Pose& ray, const Plate& plate) {
    const xr::Pose inPlate = xr::inverse(plate.stageFromPlate) * ray;
    const glm::dvec3 along = inPlate.orientation * glm::dvec3(0, 0, -1);
    if (inPlate.position.z <= 0 || along.z >= 0) return std::nullopt;
    const double distance = -inPlate.position.z / along.z;
    const glm::dvec2 meets =
        (glm::dvec2(inPlate.position) + distance * glm::dvec2(along)) / plate.half;
    if (std::abs(meets.x) > 1 || std::abs(meets.y) > 1) return std::nullopt;
    return Hit{{0.5 + 0.5 * meets.x, 0.5 - 0.5 * meets.y}, distance};
}

glm::dmat4 stageFromAxes(const xr::Placement& placement, const render::PlacedPoints& placed) {
    return xr::stageFromWorld(placement) * glm::dmat4(placed.worldFromAxes());
}

bool meetsBox(const xr::Pose& ray, const xr::Placement& placement, const glm::dmat3& boxHalfEdges) {
    const glm::dmat4 worldFromStage = glm::inverse(xr::stageFromWorld(placement));
    // In the box's own coordinates it is the cube from -1 to 1. A flat box still has a thickness.
    glm::dmat3 edges = boxHalfEdges;
    for (int i = 0; i < 3; ++i)
        if (glm::length(edges[i]) < 0.02) edges[i][i] += 0.02;
    const glm::dmat3 boxFromWorld = glm::inverse(edges);
    const glm::dvec3 from = boxFromWorld * glm::dvec3(worldFromStage * glm::dvec4(ray.position, 1));
    const glm::dvec3 along =
        boxFromWorld * (glm::dmat3(worldFromStage) * (ray.orientation * glm::dvec3(0, 0, -1)));
    const auto met = crossing(from, along, {glm::dvec3(-1), glm::dvec3(1)});
    return met && met->leaves >= 0;
}

}  // namespace app::headset
