#include "app/headset/clip_faces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

namespace app::headset {
// By the place's nearest point on each.
std::optional<Hold> nearestFace(const glm::dvec3& tip, const glm::dvec3& place, const AxisBox& box,
                                const glm::bvec3& canMove,
                                const std::function<glm::dvec3(const glm::dvec3&)>& inStage) {
    std::optional<Hold> nearest;
    double least = kReach;
    for (int axis = 0; axis < 3; ++axis) {
        if (!canMove[axis]) continue;
        // Where two faces lie in one, the tip takes the one that it would pull away.
        const int before = place[axis] > 0.5 * (box.lo[axis] + box.hi[axis]) ? 1 : -1;
        for (const int side : {before, -before}) {
            glm::dvec3 on = glm::clamp(place, box.lo, box.hi);
            on[axis] = (side < 0 ? box.lo : box.hi)[axis];
            const double distance = glm::distance(inStage(on), tip);
            if (distance >= least) continue;
            least = distance;
            nearest = Hold{{axis, side}, tip};
        }
    }
    return nearest;
}

std::optional<Crossing> crossing(const glm::dvec3& from, const glm::dvec3& along,
                                 const AxisBox& box) {
    Crossing c{-kInfinity, kInfinity, {}, {}};
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0) {
            if (from[axis] < box.lo[axis] || from[axis] > box.hi[axis]) return std::nullopt;
            continue;
        }
        const int ahead = along[axis] > 0 ? 1 : -1;
        const double lo = (box.lo[axis] - from[axis]) / along[axis];
        const double hi = (box.hi[axis] - from[axis]) / along[axis];
        if (const double at = std::min(lo, hi); at > c.enters) {
            c.enters = at;
            c.in = {axis, -ahead};
        }
        if (const double at = std::max(lo, hi); at < c.leaves) {
            c.leaves = at;
            c.out = {axis, ahead};
        }
    }
    if (c.enters > c.leaves) return std::nullopt;
    return c;
}

AxisBox clippedBox(const render::PlacedPoints& placed, const std::optional<ClipBox>& clip) {
    const glm::dvec3 half = placed.boxHalf();
    if (!clip) return {-half, half};
    const glm::dvec3 a = glm::clamp(placed.axesFromGrid(clip->lo), -half, half);
    const glm::dvec3 b = glm::clamp(placed.axesFromGrid(clip->hi), -half, half);
    return {glm::min(a, b), glm::max(a, b)};  // an axis that is drawn downwards turns them round
}

std::optional<Hold> holdOf(const xr::Pose& aim, const glm::dmat4& stageFromAxes, const AxisBox& box,
                           const glm::dvec3& boxHalf) {
    const glm::dmat4 axesFromStage = glm::inverse(stageFromAxes);
    const glm::dvec3 place(axesFromStage * glm::dvec4(aim.position, 1));
    const auto inStage = [&](const glm::dvec3& at) {
        return glm::dvec3(stageFromAxes * glm::dvec4(at, 1));
    };
    if (const auto near =
            nearestFace(aim.position, place, box, glm::notEqual(boxHalf, glm::dvec3(0)), inStage))
        return near;
    const glm::dvec3 along = aim.orientation * glm::dvec3(0, 0, -1);
    const auto met = crossing(place, glm::dmat3(axesFromStage) * along, box);
    if (!met || met->leaves < 0) return std::nullopt;
    const bool inside = met->enters < 0;
    const Face face = inside ? met->out : met->in;
    if (boxHalf[face.axis] == 0) return std::nullopt;
    return Hold{face, aim.position + (inside ? met->leaves : met->enters) * along};
}

}  // namespace app::headset
