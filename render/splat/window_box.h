// Where in a picture something in space lies at most.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "render/model/footprint.h"

namespace render {

// In window positions; hi < lo where nothing is seen.
struct WindowBox {
    glm::dvec2 lo, hi;
};

// Of what lies between these, in axis coordinates, as far as it is in front of the near plane.
// REQUIRES: at most eight.
WindowBox windowBox(const PointsView& view, std::span<const glm::dvec3> corners);

// Of all that is no farther along each axis from places than so much.
class ReachBox {
 public:
    ReachBox(const PointsView& view, const glm::dvec3& reach);
    WindowBox operator()(const glm::dvec3& place) const;

 private:
    const PointsView& view_;
    glm::dvec3 reach_{0};  // in view space
};

}  // namespace render
