// Where a rotated grid's places are on the Earth, by turning vectors.
#pragma once

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "timeseries/grid/earth_places.h"

namespace tests {

// On the unit sphere.
inline glm::dvec3 direction(const glm::dvec2& degrees) {
    const glm::dvec2 at = glm::radians(degrees);
    return {std::cos(at.y) * std::cos(at.x), std::cos(at.y) * std::sin(at.x), std::sin(at.y)};
}

// The grid's pole is tipped from the Earth's along the meridian opposite to the one on which the
// grid's places of longitude `northPole` then lie, and that is turned to where the pole belongs.
inline glm::dvec3 onEarth(const timeseries::RotatedPole& pole, const glm::dvec2& onGrid) {
    const auto about = [](double degrees, const glm::dvec3& axis) {
        return glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(degrees), axis));
    };
    return about(pole.longitude + 180, {0, 0, 1}) * about(pole.latitude - 90, {0, 1, 0}) *
           about(-pole.northPole, {0, 0, 1}) * direction(onGrid);
}

}  // namespace tests
