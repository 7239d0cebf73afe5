#include "app/headset/clip_hand.h"

#include <cassert>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "app/choices/edits.h"
#include "app/headset/clip_space.h"
#include "render/annotate/box_edges.h"

namespace app::headset {
namespace {

constexpr double kFinest = 0.001;  // metres

bool isShown(const Drawn& drawn, const Exploration& exploration) {
    const auto shown = exploration.shown();
    return shown && (shown->sorted->sharedGrid() == drawn.sorted->sharedGrid() ||
                     shown->sorted->grid() == drawn.sorted->grid());
}

ClipSpace spaceOf(const Drawn& drawn, const xr::Placement& placement) {
    return {drawn.sorted->grid(), *drawn.placed, placement};
}

// The clip box with a face at a place along its axis; a unit of the file's is so long there.
std::optional<ClipBox> withFace(const std::optional<ClipBox>& clip, Face face, double place,
                                const timeseries::Grid& grid, const ClipSpace& space,
                                double metresPerUnit) {
    const End end = (face.side < 0) != space.isReversed(face.axis) ? End::Lo : End::Hi;
    const double edge = (face.side < 0 ? space.whole().lo : space.whole().hi)[face.axis];
    double coordinate = end == End::Lo ? -std::numeric_limits<double>::infinity()
                                       : std::numeric_limits<double>::infinity();
    if (face.side * place < face.side * edge)
        coordinate = roundedTo(space.inFile(face.axis, place), kFinest / metresPerUnit);
    return withClipEnd(clip, grid, static_cast<std::size_t>(face.axis), end, coordinate);
}

}  // namespace

std::optional<Hold> ClipHand::holdAt(const xr::Pose& aim, const Drawn& drawn,
                                     const xr::Placement& placement,
                                     const Exploration& exploration) {
    if (!isShown(drawn, exploration) || !ClipSpace::has(drawn.sorted->grid(), *drawn.placed))
        return std::nullopt;
    const ClipSpace space = spaceOf(drawn, placement);
    return space.holdOf(aim, space.clipped(exploration.explorer().clip));
}

void ClipHand::take(std::size_t hand, const Hold& hold, const xr::Pose& aim, const Drawn& drawn,
                    const xr::Placement& placement, const Exploration& exploration) {
    assert(!holds(hand));
    const ClipSpace space = spaceOf(drawn, placement);
    const AxisBox box = space.clipped(exploration.explorer().clip);
    const int axis = hold.face.axis;
    const double face = (hold.face.side < 0 ? box.lo : box.hi)[axis];
    const double at = space.nearest(axis, space.fromStage(hold.at)[axis], face);
    held_[hand] = Held{.face = hold.face,
                       .inAim = (xr::inverse(aim) * xr::Pose{{1, 0, 0, 0}, hold.at}).position,
                       .offset = face - at,
                       .at = face};
}

void ClipHand::move(Exploration& exploration, const std::array<std::optional<xr::Pose>, 2>& aims,
                    const Drawn& drawn, const xr::Placement& placement) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
        auto& held = held_[hand];
        if (!held || !aims[hand] || !isShown(drawn, exploration)) continue;
        const ClipSpace space = spaceOf(drawn, placement);
        const int axis = held->face.axis;
        const glm::dvec3 at =
            space.fromStage(aims[hand]->orientation * held->inAim + aims[hand]->position);
        held->at = space.nearest(axis, at[axis] + held->offset, held->at);
        Explorer next = exploration.explorer();
        next.clip = withFace(next.clip, held->face, held->at, drawn.sorted->grid(), space,
                             space.metresPerUnit(axis, at));
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
    if (!isShown(drawn, exploration) || !ClipSpace::has(drawn.sorted->grid(), *drawn.placed))
        return edges;
    const ClipSpace space = spaceOf(drawn, {});
    const AxisBox box = space.clipped(exploration.explorer().clip);
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
        const int parts = space.partsAlong(edge.axis, 2 * half[edge.axis]);
        const auto at = [&](int part) {
            return space.inWorld(middle + edge.at(half, 2.0 * part / parts - 1));
        };
        for (int part = 0; part < parts; ++part) edges.push_back({at(part), at(part + 1), lit});
    }
    return edges;
}

}  // namespace app::headset
