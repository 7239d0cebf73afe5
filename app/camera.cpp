#include "app/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace app {
namespace {

// Half the field of view of the picture's shorter side: narrow, as for a photograph of an object.
const double kHalfAngle = glm::radians(15.0);
// The share of the picture that the box may fill; labels stand around it.
constexpr double kBoxShare = 0.80;

// From where all corners are inside the share, and none is so near that the near plane cuts it, as
// the tip of a needle seen end on. A single point is seen from 4 away.
double fittingDistance(const ViewChoice& view, const glm::dmat3& axes,
                       const glm::dmat3& boxHalfEdges, const glm::dvec2& slope) {
    constexpr double kNearestCorner = 0.3;
    if (boxHalfEdges == glm::dmat3(0) && view.target == glm::dvec3(0)) return 4;
    double distance = kNearestCorner;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::dvec3 at = glm::transpose(axes) * (boxHalfEdges * sign - view.target);
        const double nearer = view.projection == Projection::Orthographic ? 0 : at.z;
        distance = std::max({distance, nearer + kNearestCorner,
                             nearer + std::abs(at.x) / (slope.x * kBoxShare),
                             nearer + std::abs(at.y) / (slope.y * kBoxShare)});
    }
    return distance;
}

// The point midway between the eyes, and the frustum from there.
struct Camera {
    glm::dvec3 at;
    glm::dvec2 slope;
    double near, far;
};

Camera perspective(const ViewChoice& view, const Stand& stand) {
    return {.at = view.target + stand.distance * stand.axes[2],
            .slope = stand.slope,
            .near = stand.distance / 200,
            .far = stand.distance + 10 + glm::length(view.target)};
}

double farDistance(const Stand& stand) { return std::max(kFarEye, stand.distance); }

Camera orthographic(const ViewChoice& view, const Stand& stand) {
    const glm::dvec3 back = stand.axes[2];
    const double from = farDistance(stand);
    // Depths are about `from`, wherever the target is: the box is near the plane through its
    // centre. The near plane is no nearer to it than the splats' fading there allows (nearFade).
    return {.at = view.target + (from - glm::dot(view.target, back)) * back,
            .slope = stand.slope * (stand.distance / from),
            .near = from / 2 - 1,
            .far = from + 2};
}

}  // namespace

Stand standOf(const ViewChoice& view, const glm::dmat3& boxHalfEdges, glm::ivec2 size) {
    const double azimuth = glm::radians(view.azimuthDegrees);
    const double elevation = glm::radians(view.elevationDegrees);
    // Right comes from the azimuth alone, so that looking straight down is no special case.
    const glm::dvec3 right(std::cos(azimuth), std::sin(azimuth), 0);
    const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation),
                          -std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
    const glm::dmat3 axes(right, glm::cross(back, right), back);
    const double shorter = std::min(size.x, size.y);
    const glm::dvec2 slope = std::tan(kHalfAngle) * glm::dvec2(size) / shorter;
    return {axes, view.distance.value_or(fittingDistance(view, axes, boxHalfEdges, slope)), slope};
}

std::vector<render::View> eyes(const ViewChoice& view, const StereoChoice& stereo,
                               const glm::dmat3& boxHalfEdges, glm::ivec2 size) {
    const Stand stand = standOf(view, boxHalfEdges, size);
    const bool isFar = view.projection == Projection::Orthographic;
    const Camera camera = isFar ? orthographic(view, stand) : perspective(view, stand);
    const auto eye = [&](double sideways, double convergence) {
        const double shift = -sideways / convergence;
        const glm::dvec3 at = camera.at + sideways * stand.axes[0];
        const glm::dvec2 slope = camera.slope;
        glm::dmat4 viewFromWorld(glm::transpose(stand.axes));
        viewFromWorld[3] = glm::dvec4(glm::dmat3(viewFromWorld) * -at, 1.0);
        return render::View{
            .clipFromView = render::clipFromView(
                {-slope.x + shift, slope.x + shift, -slope.y, slope.y, camera.near, camera.far}),
            .viewFromWorld = viewFromWorld,
            .size = size};
    };
    if (stereo.mode == Stereo::Off) return {eye(0, 1)};
    double apart = stereo.eyeDistance.value_or(stand.distance / 30);
    double convergence = stereo.convergence.value_or(stand.distance);
    if (isFar) {
        // Parallax is apart (1 / convergence - 1 / depth): the same change with depth, in shares of
        // the picture, about the same plane of none.
        const double from = farDistance(stand);
        apart *= from * stand.distance / (convergence * convergence);
        convergence += from - stand.distance;
    }
    return {eye(-apart / 2, convergence), eye(apart / 2, convergence)};
}

}  // namespace app
