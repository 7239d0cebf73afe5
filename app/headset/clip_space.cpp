#include "app/headset/clip_space.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "app/headset/standing.h"

namespace app::headset {
namespace {

constexpr int kThird = 2;

bool isWithin(const AxisBox& box, const glm::dvec3& place) {
    return glm::clamp(place, box.lo, box.hi) == place;
}

}  // namespace

ClipSpace::ClipSpace(const timeseries::Grid& grid, const render::PlacedPoints& placed,
                     const xr::Placement& placement)
    : placed_(placed),
      stageFromAxes_(stageFromAxes(placement, placed)),
      axesFromStage_(glm::inverse(stageFromAxes_)),
      metres_(placement.metresPerUnit),
      whole_{-placed.boxHalf(), placed.boxHalf()} {
    if (!isGlobe()) return;
    for (int axis = 0; axis < 3; ++axis) {
        const auto ends = grid.ends(static_cast<std::size_t>(axis));
        whole_.lo[axis] = ends.least;
        whole_.hi[axis] = ends.most;
    }
}

bool ClipSpace::has(const timeseries::Grid& grid, const render::PlacedPoints& placed) {
    return !placed.globe() || !grid.earth();
}

glm::dvec3 ClipSpace::fromStage(const glm::dvec3& at) const {
    const glm::dvec3 axes(axesFromStage_ * glm::dvec4(at, 1));
    return isGlobe() ? placed_.globe()->placeOf(placed_.gridFromAxes(axes)) : axes;
}

glm::dvec3 ClipSpace::inStage(const glm::dvec3& place) const {
    const glm::dvec3 axes = isGlobe() ? placed_.axesFromGlobe(placed_.globe()->at(place)) : place;
    return glm::dvec3(stageFromAxes_ * glm::dvec4(axes, 1));
}

glm::dvec3 ClipSpace::inWorld(const glm::dvec3& place) const {
    if (isGlobe()) return placed_.axesFromGlobe(placed_.globe()->at(place));
    return placed_.worldFromAxes() * place;
}

AxisBox ClipSpace::clipped(const std::optional<ClipBox>& clip) const {
    if (!isGlobe()) return clippedBox(placed_, clip);
    if (!clip) return whole_;
    return {glm::clamp(clip->lo, whole_.lo, whole_.hi), glm::clamp(clip->hi, whole_.lo, whole_.hi)};
}

std::optional<Hold> ClipSpace::holdOf(const xr::Pose& aim, const AxisBox& box) const {
    if (!isGlobe()) return headset::holdOf(aim, stageFromAxes_, box, placed_.boxHalf());
    if (const auto near = nearestFace(aim.position, fromStage(aim.position), box,
                                      glm::notEqual(whole_.lo, whole_.hi),
                                      [&](const glm::dvec3& place) { return inStage(place); }))
        return near;
    return onRay(aim, box);
}

// Ascending: even steps, and where the ray meets the two spheres between which the box lies, which
// may be thinner than a step.
std::vector<double> ClipSpace::stepsOnRay(const glm::dvec3& eye, const glm::dvec3& way,
                                          const AxisBox& box, double farthest) const {
    constexpr int kSteps = 1024;
    std::vector<double> steps;
    for (int n = 0; n <= kSteps; ++n) steps.push_back(farthest * n / kSteps);
    const glm::dvec3 centre = placed_.axesFromGlobe(glm::dvec3(0)), from = eye - centre;
    const double a = glm::dot(way, way), b = glm::dot(from, way);
    for (const glm::dvec3& end : {box.lo, box.hi}) {
        const double radius =
            glm::distance(placed_.axesFromGlobe(placed_.globe()->at(end)), centre);
        const double root =
            std::sqrt(std::max(b * b - a * (glm::dot(from, from) - radius * radius), 0.0));
        for (const double t : {(-b - root) / a, (-b + root) / a})
            if (t > 0 && t < farthest) steps.push_back(t);
    }
    std::ranges::sort(steps);
    return steps;
}

// Up to where the Earth hides the rest: between which steps it comes in or leaves, then by halves.
std::optional<Hold> ClipSpace::onRay(const xr::Pose& aim, const AxisBox& box) const {
    constexpr int kHalvings = 40;
    if (whole_.lo[kThird] == whole_.hi[kThird]) return std::nullopt;  // no thickness to be in
    const glm::dvec3 along = aim.orientation * glm::dvec3(0, 0, -1);
    const glm::dvec3 eye(axesFromStage_ * glm::dvec4(aim.position, 1)),
        way = glm::dmat3(axesFromStage_) * along;
    const double past = (glm::length(eye) + 2) / glm::length(way);  // the box is within 1
    const double farthest = std::min(past, placed_.ballOnRay(eye, way));
    const auto at = [&](double t) { return aim.position + t * along; };
    const auto isIn = [&](double t) { return isWithin(box, fromStage(at(t))); };
    const bool begins = isIn(0);
    const std::vector<double> steps = stepsOnRay(eye, way, box, farthest);
    double before = 0;
    for (std::size_t n = 1; n < steps.size(); ++n) {
        double after = 0.5 * (steps[n - 1] + steps[n]);
        if (isIn(after) == begins) {
            before = after;
            continue;
        }
        for (int i = 0; i < kHalvings; ++i) {
            const double half = 0.5 * (before + after);
            (isIn(half) == begins ? before : after) = half;
        }
        // The coordinate that is beyond the box there, and how it leads back.
        const glm::dvec3 outside = fromStage(at(begins ? after : before));
        for (int axis = 0; axis < 3; ++axis) {
            if (outside[axis] >= box.lo[axis] && outside[axis] <= box.hi[axis]) continue;
            return Hold{{axis, outside[axis] < box.lo[axis] ? -1 : 1}, at(after)};
        }
    }
    return std::nullopt;
}

double ClipSpace::inFile(int axis, double coordinate) const {
    if (isGlobe()) return coordinate;
    glm::dvec3 at(0);
    at[axis] = coordinate;
    return placed_.gridFromAxes(at)[axis];
}

double ClipSpace::metresPerUnit(int axis, const glm::dvec3& place) const {
    if (!isGlobe()) return std::abs(placed_.scale()[axis]) * metres_;
    return metres_ * placed_.scale().x * glm::length(placed_.globe()->waysAt(place)[axis]);
}

double ClipSpace::nearest(int axis, double coordinate, double to) const {
    constexpr double kTurn = 360;
    if (!isGlobe() || axis != 0) return coordinate;
    return coordinate + kTurn * std::round((to - coordinate) / kTurn);
}

int ClipSpace::partsAlong(int axis, double length) const {
    constexpr double kStraight = 10;  // degrees
    if (!isGlobe() || axis == kThird) return 1;
    return std::max(1, static_cast<int>(std::ceil(length / kStraight)));
}

}  // namespace app::headset
