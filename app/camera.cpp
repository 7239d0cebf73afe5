#include "app/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace app {
namespace {

// Half the field of view of the picture's shorter side: narrow, as for a photograph of an object.
const double kHalfAngle = glm::radians(15.0);
// The share of the picture that the box may fill; labels stand around it.
constexpr double kBoxShare = 0.80;

// From where all corners are inside the share, and none is so near that the near plane cuts it, as
// the tip of a needle seen end on. A single point is seen from 4 away.
double fittingDistance(const glm::dmat3& axes, const glm::dmat3& boxHalfEdges,
                       const glm::dvec2& slope) {
    constexpr double kNearestCorner = 0.3;
    if (boxHalfEdges == glm::dmat3(0)) return 4;
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::dvec3 at = glm::transpose(axes) * (boxHalfEdges * sign);
        distance = std::max({distance, at.z + kNearestCorner,
                             at.z + std::abs(at.x) / (slope.x * kBoxShare),
                             at.z + std::abs(at.y) / (slope.y * kBoxShare)});
    }
    return distance;
}

}  // namespace

std::vector<render::View> eyes(const ViewChoice& view, const StereoChoice& stereo,
                               const glm::dmat3& boxHalfEdges, glm::ivec2 size) {
    const double azimuth = glm::radians(view.azimuthDegrees);
    const double elevation = glm::radians(view.elevationDegrees);
    // Right comes from the azimuth alone, so that looking straight down is no special case.
    const glm::dvec3 right(std::cos(azimuth), std::sin(azimuth), 0);
    const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation),
                          -std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
    const glm::dvec3 up = glm::cross(back, right);

    const double tangent = std::tan(kHalfAngle);
    const double shorter = std::min(size.x, size.y);
    const glm::dvec2 slope = tangent * glm::dvec2(size) / shorter;
    const double distance =
        view.distance.value_or(fittingDistance(glm::dmat3(right, up, back), boxHalfEdges, slope));
    const double near = distance / 200, far = distance + 10;
    const auto eye = [&](double sideways, double convergence) {
        const double shift = -sideways / convergence;
        const glm::dvec3 at = distance * back + sideways * right;
        glm::dmat4 viewFromWorld(glm::transpose(glm::dmat3(right, up, back)));
        viewFromWorld[3] = glm::dvec4(glm::dmat3(viewFromWorld) * -at, 1.0);
        return render::View{.clipFromView = render::clipFromView(
                                {-slope.x + shift, slope.x + shift, -slope.y, slope.y, near, far}),
                            .viewFromWorld = viewFromWorld,
                            .size = size};
    };
    if (stereo.mode == Stereo::Off) return {eye(0, 1)};
    const double apart = stereo.eyeDistance.value_or(distance / 30);
    const double convergence = stereo.convergence.value_or(distance);
    return {eye(-apart / 2, convergence), eye(apart / 2, convergence)};
}

}  // namespace app
