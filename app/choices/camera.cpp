#include "app/choices/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "render/annotate/axes.h"

namespace app {
namespace {

// Half the field of view of the picture's shorter side: narrow, as for a photograph of an object.
const double kHalfAngle = glm::radians(15.0);
// The box's corners as the camera sees them from the target, along right, up and back.
std::array<glm::dvec3, 8> cornersOf(const glm::dmat3& axes, const glm::dmat3& boxHalfEdges,
                                    const glm::dvec3& target) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const glm::dvec3 sign(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
        corners[c] = glm::transpose(axes) * (boxHalfEdges * sign - target);
    }
    return corners;
}

// Where the eye stands back and how far the target is moved right and up, in the world.
struct Fit {
    double distance;
    glm::dvec2 aside{0};
};

// From where all corners are inside, and none is so near that the near plane cuts it, as the tip of
// a needle seen end on. A single point is seen from 4 away.
//
// A corner at x and depth d - z is drawn at (x - a) / (s (d - z)) half pictures from the middle, a
// being how far the target is aside and s the slope. That is at most m for all where, for every two
// corners,
//   x1 - x2 <= s m (2 d - z1 - z2),
// which gives the least d; a may then be chosen between the bounds that single corners give it.
Fit boxFit(const ViewChoice& view, const glm::dmat3& axes, const glm::dmat3& boxHalfEdges,
           const glm::dvec2& slope, const glm::dvec2& most) {
    constexpr double kNearestCorner = 0.6;
    const bool isCentred = view.target == glm::dvec3(0);
    if (boxHalfEdges == glm::dmat3(0) && isCentred) return {4};
    auto corners = cornersOf(axes, boxHalfEdges, view.target);
    if (view.projection == Projection::Orthographic)
        for (glm::dvec3& corner : corners) corner.z = 0;
    const glm::dvec2 reach = slope * most;
    Fit fit{kNearestCorner};
    for (const glm::dvec3& one : corners) {
        fit.distance = std::max(fit.distance, one.z + kNearestCorner);
        for (int k = 0; k < 2; ++k) {
            if (!isCentred)
                fit.distance = std::max(fit.distance, one.z + std::abs(one[k]) / reach[k]);
            for (const glm::dvec3& other : corners)
                fit.distance = std::max(fit.distance,
                                        0.5 * ((one[k] - other[k]) / reach[k] + one.z + other.z));
        }
    }
    if (!isCentred) return fit;
    for (int k = 0; k < 2; ++k) {
        double least = -std::numeric_limits<double>::infinity(), greatest = -least;
        for (const glm::dvec3& corner : corners) {
            const double half = reach[k] * (fit.distance - corner.z);
            least = std::max(least, corner[k] - half);
            greatest = std::min(greatest, corner[k] + half);
        }
        fit.aside[k] = 0.5 * (least + greatest);
    }
    return fit;
}

// The point midway between the eyes, and the frustum from there.
struct Camera {
    glm::dvec3 at;
    glm::dvec2 slope;
    double near, far;
};

Camera perspective(const Stand& stand) {
    return {.at = stand.target + stand.distance * stand.axes[2],
            .slope = stand.slope,
            .near = stand.distance / 200,
            .far = stand.distance + 10 + glm::length(stand.target)};
}

double farDistance(const Stand& stand) { return std::max(kFarEye, stand.distance); }

Camera orthographic(const Stand& stand) {
    const glm::dvec3 back = stand.axes[2];
    const double from = farDistance(stand);
    // Depths are about `from`, wherever the target is: the box is near the plane through its
    // centre. The near plane is no nearer to it than the splats' fading there allows (nearFade).
    return {.at = stand.target + (from - glm::dot(stand.target, back)) * back,
            .slope = stand.slope * (stand.distance / from),
            .near = from / 2 - 1,
            .far = from + 2};
}

// A ball at x and z, of radius h: the frustum's side x - a = s m (d - z) is h or more away from its
// centre where s m (d - z) >= |x| + h sqrt(1 + (s m)^2); parallel sides where s m d >= |x| + h.
Fit ballFit(const ViewChoice& view, const glm::dmat3& axes, double radius,
            const glm::dvec2& reach) {
    const glm::dvec3 centre = glm::transpose(axes) * -view.target;
    const bool isParallel = view.projection == Projection::Orthographic;
    double distance = 0;
    for (int k = 0; k < 2; ++k) {
        const double wide = isParallel ? radius : radius * std::sqrt(1 + reach[k] * reach[k]);
        distance = std::max(distance, (std::abs(centre[k]) + wide) / reach[k]);
    }
    return {distance + (isParallel ? 0 : centre.z)};
}

Fit fittingStand(const ViewChoice& view, const glm::dmat3& axes, const render::Outline& outline,
                 const glm::dvec2& slope, const glm::dvec2& most) {
    if (outline.isBall)
        return ballFit(view, axes, outline.boxHalfEdges[0].x, kBoxShare * slope * most);
    const Fit box = boxFit(view, axes, outline.boxHalfEdges, slope, kBoxShare * most);
    // Of few points, the outermost cells reach farther than what the box leaves free.
    const auto isFree = [&](const glm::dvec3& corner) {
        const double depth = view.projection == Projection::Orthographic ? 0 : corner.z;
        const glm::dvec2 half = slope * most * (box.distance - depth);
        return glm::all(glm::lessThanEqual(glm::abs(glm::dvec2(corner) - box.aside), half));
    };
    if (std::ranges::all_of(cornersOf(axes, outline.filledHalfEdges, view.target), isFree))
        return box;
    return boxFit(view, axes, outline.filledHalfEdges, slope, most);
}

}  // namespace

glm::dvec2 freeAreaOf(glm::ivec2 size) {
    // Lines of labels: a title and the time above, numbers and a name below, numbers beside. Of a
    // picture too small for labels, most is the box's all the same.
    constexpr glm::dvec2 kLines(1.5, 2);
    const double line =
        std::min<double>(render::labelStyle(size).linePixels, 0.05 * std::min(size.x, size.y));
    return 1.0 - 2 * line * kLines / glm::dvec2(size);
}

glm::dvec3 directionOf(double azimuthDegrees, double elevationDegrees) {
    const double azimuth = glm::radians(azimuthDegrees);
    const double elevation = glm::radians(elevationDegrees);
    return {std::sin(azimuth) * std::cos(elevation), -std::cos(azimuth) * std::cos(elevation),
            std::sin(elevation)};
}

Stand standOf(const ViewChoice& view, const render::Outline& outline, glm::ivec2 size) {
    const double azimuth = glm::radians(view.azimuthDegrees);
    // Right comes from the azimuth alone, so that looking straight down is no special case.
    const glm::dvec3 right(std::cos(azimuth), std::sin(azimuth), 0);
    const glm::dvec3 back = directionOf(view.azimuthDegrees, view.elevationDegrees);
    const glm::dmat3 axes(right, glm::cross(back, right), back);
    const double shorter = std::min(size.x, size.y);
    const glm::dvec2 slope = std::tan(kHalfAngle) * glm::dvec2(size) / shorter;
    Stand stand{axes, 0, view.target, slope};
    if (view.distance) {
        stand.distance = *view.distance;
        return stand;
    }
    const Fit fit = fittingStand(view, axes, outline, slope, freeAreaOf(size));
    stand.distance = fit.distance;
    stand.target += fit.aside.x * axes[0] + fit.aside.y * axes[1];
    return stand;
}

std::vector<render::View> eyes(const ViewChoice& view, const StereoChoice& stereo,
                               const render::Outline& outline, glm::ivec2 size) {
    const Stand stand = standOf(view, outline, size);
    const bool isFar = view.projection == Projection::Orthographic;
    const Camera camera = isFar ? orthographic(stand) : perspective(stand);
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
