#include "app/headset/clip_hand.h"

#include <cassert>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "app/choices/edits.h"
#include "app/headset/standing.h"
#include "render/annotate/box_edges.h"

namespace app::headset {
namespace {

constexpr double kFinest = 0.001;  // metres

double along(int axis, const glm::dvec3& at, const Drawn& drawn, const xr::Placement& placement) {
    const glm::dmat4 axesFromStage = glm::inverse(stageFromAxes(placement, *drawn.placed));
    return (axesFromStage * glm::dvec4(at, 1))[axis];
}

bool isShown(const Drawn& drawn, const Exploration& exploration) {
    const auto shown = exploration.shown();
    return shown && (shown->sorted->sharedGrid() == drawn.sorted->sharedGrid() ||
                     shown->sorted->grid() == drawn.sorted->grid());
}

// The clip box with a face at a place along its axis, in axis coordinates.
std::optional<ClipBox> withFace(const std::optional<ClipBox>& clip, Face face, double place,
                                const Drawn& drawn, double metresPerUnit) {
    const render::PlacedPoints& placed = *drawn.placed;
    const double scale = placed.scale()[face.axis];
    const End end = (face.side < 0) == (scale > 0) ? End::Lo : End::Hi;
    const bool isBounded = face.side * place < placed.boxHalf()[face.axis];
    double coordinate = end == End::Lo ? -std::numeric_limits<double>::infinity()
                                       : std::numeric_limits<double>::infinity();
    if (isBounded) {
        glm::dvec3 at(0);
        at[face.axis] = place;
        coordinate = roundedTo(placed.gridFromAxes(at)[face.axis],
                               kFinest / (std::abs(scale) * metresPerUnit));
    }
    return withClipEnd(clip, drawn.sorted->grid(), static_cast<std::size_t>(face.axis), end,
                       coordinate);
}

}  // namespace

std::optional<Hold> ClipHand::holdAt(const xr::Pose& aim, const Drawn& drawn,
                                     const xr::Placement& placement,
                                     const Exploration& exploration) {
    // On a globe the box of the file's coordinates has no faces that a hand could hold.
    if (!isShown(drawn, exploration) || drawn.placed->globe()) return std::nullopt;
    return holdOf(aim, stageFromAxes(placement, *drawn.placed),
                  clippedBox(*drawn.placed, exploration.explorer().clip), drawn.placed->boxHalf());
}

void ClipHand::take(std::size_t hand, const Hold& hold, const xr::Pose& aim, const Drawn& drawn,
                    const xr::Placement& placement, const Exploration& exploration) {
    assert(!holds(hand));
    const AxisBox box = clippedBox(*drawn.placed, exploration.explorer().clip);
    const int axis = hold.face.axis;
    held_[hand] = Held{.face = hold.face,
                       .inAim = (xr::inverse(aim) * xr::Pose{{1, 0, 0, 0}, hold.at}).position,
                       .offset = (hold.face.side < 0 ? box.lo : box.hi)[axis] -
                                 along(axis, hold.at, drawn, placement)};
}

void ClipHand::move(Exploration& exploration, const std::array<std::optional<xr::Pose>, 2>& aims,
                    const Drawn& drawn, const xr::Placement& placement) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
        const auto& held = held_[hand];
        if (!held || !aims[hand] || !isShown(drawn, exploration)) continue;
        const glm::dvec3 at = aims[hand]->orientation * held->inAim + aims[hand]->position;
        const double place = along(held->face.axis, at, drawn, placement) + held->offset;
        Explorer next = exploration.explorer();
        next.clip = withFace(next.clip, held->face, place, drawn, placement.metresPerUnit);
        if (next.clip != exploration.explorer().clip)
            exploration.edit(std::move(next), "clip by hand");
    }
}

void ClipHand::letGo(std::size_t hand, Exploration& exploration) {
    if (!std::exchange(held_[hand], std::nullopt)) return;
    if (!holds(1 - hand)) exploration.endGesture();
}

std::vector<ClipHand::Edge> ClipHand::edges(const std::array<std::optional<Hold>, 2>& within,
                                            const Drawn& drawn,
                                            const Exploration& exploration) const {
    std::vector<Edge> edges;
    if (!isShown(drawn, exploration) || drawn.placed->globe()) return edges;
    const AxisBox box = clippedBox(*drawn.placed, exploration.explorer().clip);
    const glm::dvec3 half = 0.5 * (box.hi - box.lo), middle = 0.5 * (box.hi + box.lo);
    const auto isOf = [&](const render::Edge& edge, const Face& face) {
        return edge.axis != face.axis &&
               (edge.side[face.axis] == face.side || half[face.axis] == 0);
    };
    for (const render::Edge& edge : render::edges(half)) {
        bool lit = false;
        for (std::size_t hand = 0; hand < 2; ++hand) {
            if (held_[hand])
                lit = lit || isOf(edge, held_[hand]->face);
            else if (within[hand])
                lit = lit || isOf(edge, within[hand]->face);
        }
        edges.push_back({drawn.placed->worldFromAxes() * (middle + edge.at(half, -1)),
                         drawn.placed->worldFromAxes() * (middle + edge.at(half, 1)), lit});
    }
    return edges;
}

}  // namespace app::headset
