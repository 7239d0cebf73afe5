// The edges of a grid's box and where an eye sees them. All in axis coordinates
// (render/points/placed_points.h), where the box is upright; views are PlacedPoints::inAxes.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "render/points/view.h"

namespace render {

// An edge of the box: along `axis`, at the sides (-1 or 1) of the two others; side[axis] is 0.
struct Edge {
    int axis;
    glm::ivec3 side;
    glm::dvec3 at(const glm::dvec3& half, double along) const {
        glm::dvec3 p = half * glm::dvec3(side);
        p[axis] = along * half[axis];
        return p;
    }
};

// Of the box with these half sides. A flat box has fewer edges: its two sides along a flat axis are
// one.
std::vector<Edge> edges(const glm::dvec3& half);

// How an edge lies for an eye: between two faces that show, on the outline, or behind.
enum class Lies { Front, Outline, Behind };
Lies lies(const Edge& edge, const glm::dvec3& half, const glm::dvec3& eye);

// Where points are in a picture.
class Screen {
 public:
    explicit Screen(const View& view);

    // Picture pixels from the top left, window depth. REQUIRES: before the near plane.
    glm::dvec3 pixel(const glm::dvec3& at) const;
    // The part of a to b, as fractions, before the near plane; or in the picture as well.
    enum class Cut { NearPlane, Picture };
    std::optional<glm::dvec2> visible(const glm::dvec3& a, const glm::dvec3& b, Cut cut) const;

 private:
    glm::dmat4 clipFromAxes_;
    glm::dvec2 size_;
};

// The point midway between a picture's eyes, and how far off the view axis their pictures lie on
// the average: as clipFromView[2] has it. That is a shift, which both have, without parallax.
struct Middle {
    glm::dvec3 eye;
    glm::dvec2 lean{0};
};
// What one of the eyes would see from there.
View viewFrom(const Middle& middle, const View& eye);

}  // namespace render
