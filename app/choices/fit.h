// From where all of a box or ball is seen. Pure; camera.h says what a picture without a distance
// shows.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render/points/placed_points.h"

namespace app {

// How it is looked at.
struct Looks {
    glm::dmat3 axes;    // columns: right, up, back (towards the eye)
    glm::dvec2 slope;   // half the picture's width and height at distance 1
    glm::dvec3 target;  // at 0 it is chosen: what is seen of the box stands in the middle
    bool isParallel;
    glm::dvec2 free;  // the part of the picture that may be filled, in halves of its sides
};

struct Fit {
    double distance;
    glm::dvec2 aside{0};  // how far the target is moved right and up, in the world
    glm::dvec2 shift{0};  // and all of the picture, in halves of its sides
};

Fit fitOf(const Looks& looks, const render::Outline& outline);
// Shifted, and from farther where need be, so that a legend of this size in pixels covers none of
// it; where that cannot be, the same as without. REQUIRES: a target at 0.
Fit fitBeside(const glm::dvec2& legend, glm::ivec2 size, const Looks& looks,
              const render::Outline& outline);

}  // namespace app
