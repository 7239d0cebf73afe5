#include "app/choices/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "app/choices/beside_legend.h"
#include "app/choices/camera.h"

namespace app {
namespace {

using Corners = std::array<glm::dvec3, 8>;

// The box's corners as the camera sees them from the target, along right, up and back; of parallel
// rays they all lie in the target's plane.
Corners cornersOf(const Looks& looks, const glm::dmat3& boxHalfEdges) {
    Corners corners;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const glm::dvec3 sign(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
        corners[c] = glm::transpose(looks.axes) * (boxHalfEdges * sign - looks.target);
        if (looks.isParallel) corners[c].z = 0;
    }
    return corners;
}

// The target's way aside that leaves as much free on both sides, of what may be filled up to
// `reach`.
glm::dvec2 asideAt(double distance, const Corners& corners, const glm::dvec2& reach) {
    glm::dvec2 aside;
    for (int k = 0; k < 2; ++k) {
        double least = -std::numeric_limits<double>::infinity(), greatest = -least;
        for (const glm::dvec3& corner : corners) {
            const double half = reach[k] * (distance - corner.z);
            least = std::max(least, corner[k] - half);
            greatest = std::min(greatest, corner[k] + half);
        }
        aside[k] = 0.5 * (least + greatest);
    }
    return aside;
}

// From where all corners are inside, and none is so near that the near plane cuts it, as the tip of
// a needle seen end on. A single point is seen from 4 away.
//
// A corner at x and depth d - z is drawn at (x - a) / (s (d - z)) half pictures from the middle, a
// being how far the target is aside and s the slope. That is at most m for all where, for every two
// corners,
//   x1 - x2 <= s m (2 d - z1 - z2),
// which gives the least d; a may then be chosen between the bounds that single corners give it.
Fit boxFit(const Looks& looks, const glm::dmat3& boxHalfEdges, const glm::dvec2& most) {
    constexpr double kNearestCorner = 0.6;
    const bool isCentred = looks.target == glm::dvec3(0);
    if (boxHalfEdges == glm::dmat3(0) && isCentred) return {4};
    const Corners corners = cornersOf(looks, boxHalfEdges);
    const glm::dvec2 reach = looks.slope * most;
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
    if (isCentred) fit.aside = asideAt(fit.distance, corners, reach);
    return fit;
}

// A ball at x and z, of radius h: the frustum's side x - a = s m (d - z) is h or more away from its
// centre where s m (d - z) >= |x| + h sqrt(1 + (s m)^2); parallel sides where s m d >= |x| + h.
Fit ballFit(const Looks& looks, double radius, const glm::dvec2& reach) {
    const glm::dvec3 centre = glm::transpose(looks.axes) * -looks.target;
    double distance = 0;
    for (int k = 0; k < 2; ++k) {
        const double wide = looks.isParallel ? radius : radius * std::sqrt(1 + reach[k] * reach[k]);
        distance = std::max(distance, (std::abs(centre[k]) + wide) / reach[k]);
    }
    return {distance + (looks.isParallel ? 0 : centre.z)};
}

// What of the picture it is seen in from there, in halves of its sides.
std::vector<glm::dvec2> boxFrom(const Fit& fit, const Corners& corners, const glm::dvec2& slope) {
    std::vector<glm::dvec2> seen;
    for (const glm::dvec3& corner : corners)
        seen.push_back((glm::dvec2(corner) - fit.aside) / (slope * (fit.distance - corner.z)));
    return seen;
}

// A polygon around a ball at 0.
std::vector<glm::dvec2> ballFrom(double distance, double radius, const Looks& looks) {
    constexpr int kSides = 32;
    const double tangent =
        radius / (looks.isParallel ? distance : std::sqrt(distance * distance - radius * radius));
    const double outside = 1 / std::cos(glm::radians(180.0 / kSides));
    std::vector<glm::dvec2> seen;
    for (int i = 0; i < kSides; ++i) {
        const double turn = glm::radians(360.0 * i / kSides);
        seen.push_back(outside * tangent / looks.slope *
                       glm::dvec2(std::cos(turn), std::sin(turn)));
    }
    return seen;
}

// The fit's own picture from farther away.
struct Farther {
    const Looks& looks;
    const render::Outline& outline;
    Corners box, filled;
    Fit fit;

    Fit at(double distance) const {
        if (outline.isBall) return {distance};
        return {distance, asideAt(distance, box, kBoxShare * looks.free * looks.slope)};
    }
    std::vector<glm::dvec2> seen(const Fit& from) const {
        if (outline.isBall) return ballFrom(from.distance, outline.boxHalfEdges[0].x, looks);
        return boxFrom(from, filled, looks.slope);
    }
};

}  // namespace

Fit fitOf(const Looks& looks, const render::Outline& outline) {
    if (outline.isBall)
        return ballFit(looks, outline.boxHalfEdges[0].x, kBoxShare * looks.slope * looks.free);
    const Fit box = boxFit(looks, outline.boxHalfEdges, kBoxShare * looks.free);
    // Of few points, the outermost cells reach farther than what the box leaves free.
    const auto isFree = [&](const glm::dvec2& at) {
        return glm::all(glm::lessThanEqual(glm::abs(at), looks.free));
    };
    const Corners filled = cornersOf(looks, outline.filledHalfEdges);
    if (std::ranges::all_of(boxFrom(box, filled, looks.slope), isFree)) return box;
    return boxFit(looks, outline.filledHalfEdges, looks.free);
}

Fit fitBeside(const glm::dvec2& legend, glm::ivec2 size, const Looks& looks,
              const render::Outline& outline) {
    const glm::dvec2 half = 0.5 * glm::dvec2(size);
    const Farther farther{looks, outline, cornersOf(looks, outline.boxHalfEdges),
                          cornersOf(looks, outline.filledHalfEdges), fitOf(looks, outline)};
    const RoomInPicture room{half * kBoxShare * looks.free, {legend.x - half.x, half.y - legend.y}};
    const auto clear = [&](const Fit& from) -> std::optional<Fit> {
        std::vector<glm::dvec2> seen = farther.seen(from);
        for (glm::dvec2& at : seen) at *= half;
        const auto shift = leastShift(seen, room);
        if (!shift) return std::nullopt;
        return Fit{from.distance, from.aside, *shift / half};
    };
    if (const auto there = clear(farther.fit)) return *there;
    std::optional<Fit> best = clear(farther.at(kFarther * farther.fit.distance));
    if (!best) return farther.fit;
    double tooNear = farther.fit.distance;
    for (int i = 0; i < 20; ++i) {
        const double between = 0.5 * (tooNear + best->distance);
        if (const auto there = clear(farther.at(between)))
            best = there;
        else
            tooNear = between;
    }
    return *best;
}

}  // namespace app
