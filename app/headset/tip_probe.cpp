#include "app/headset/tip_probe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "app/headset/standing.h"

namespace app::headset {
namespace {

// REQUIRES: strictly ascending or descending, not empty.
std::size_t nearest(const std::vector<double>& positions, double place) {
    const auto at =
        positions.front() <= positions.back()
            ? std::lower_bound(positions.begin(), positions.end(), place)
            : std::lower_bound(positions.begin(), positions.end(), place, std::greater<>());
    if (at == positions.begin()) return 0;
    if (at == positions.end() || std::abs(place - at[-1]) <= std::abs(*at - place))
        return static_cast<std::size_t>(at - positions.begin()) - 1;
    return static_cast<std::size_t>(at - positions.begin());
}

// By steps from neighbour to neighbour, each nearer, from the nearest of a few that are spread over
// the mesh; where there are no neighbours, of all. None where what is found is farther off than any
// cell reaches.
std::optional<std::array<std::size_t, 3>> nearestOfMesh(const render::PlacedPoints& placed,
                                                        const glm::dvec3& place) {
    // Indices between those that are looked at first.
    const std::uint64_t spread = placed.hasNeighbours() ? 8 : 1;
    using Index = glm::vec<3, std::uint64_t>;
    const Index size(placed.size());
    const auto away = [&](const Index& at) {
        const double far =
            glm::distance(placed.alongAxes(at.x + size.x * (at.y + size.y * at.z)), place);
        return std::isnan(far) ? std::numeric_limits<double>::infinity() : far;
    };
    Index best(0);
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](const Index& at) {
        const double far = away(at);
        if (!(far < least)) return false;
        least = far;
        best = at;
        return true;
    };
    for (std::uint64_t k = 0; k < size.z; k += spread)
        for (std::uint64_t j = 0; j < size.y; j += spread)
            for (std::uint64_t i = 0; i < size.x; i += spread) look({i, j, k});
    for (bool isNearer = placed.hasNeighbours(); isNearer;) {
        isNearer = false;
        const Index from = best;
        for (int a = 0; a < 3; ++a)
            for (const bool up : {false, true}) {
                Index next = from;
                if (up ? next[a] + 1 == size[a] : next[a] == 0) continue;
                next[a] += up ? 1 : -1;
                isNearer = look(next) || isNearer;
            }
    }
    if (!(least <= placed.widest())) return std::nullopt;
    return std::array<std::size_t, 3>{best.x, best.y, best.z};
}

std::optional<std::array<std::size_t, 3>> pointAtTip(const Drawn& drawn,
                                                     const xr::Placement& placement,
                                                     const glm::dvec3& tip) {
    const glm::dmat4 axesFromStage = glm::inverse(stageFromAxes(placement, *drawn.placed));
    return pointAt(*drawn.placed, glm::dvec3(axesFromStage * glm::dvec4(tip, 1)));
}

// All of a reading but its value.
Reading placeOf(const Drawn& drawn, const std::array<std::size_t, 3>& index, std::uint64_t i) {
    return {.index = index,
            .value = {},
            .position = drawn.sorted->grid().position(i),
            .world = drawn.placed->position(i),
            .step = drawn.step,
            .cell = cellText(drawn.sorted->grid(), index)};
}

std::uint64_t gridIndexOf(const render::PlacedPoints& placed,
                          const std::array<std::size_t, 3>& at) {
    const glm::uvec3 size = placed.size();
    return at[0] + size.x * (at[1] + size.y * at[2]);
}

}  // namespace

std::optional<std::array<std::size_t, 3>> pointAt(const render::PlacedPoints& placed,
                                                  const glm::dvec3& place) {
    std::array<std::size_t, 3> index{};
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        const double half = placed.boxHalf()[a];
        const double thin = placed.isMesh() ? placed.widest() : placed.widths()[axis][0];
        const double reach = half > 0 ? half : 0.5 * thin;
        if (!(std::abs(place[a]) <= reach)) return std::nullopt;
        if (!placed.isMesh()) index[axis] = nearest(placed.positions()[axis], place[a]);
    }
    return placed.isMesh() ? nearestOfMesh(placed, place) : index;
}

void TipProbe::update(const std::optional<Drawn>& drawn, const xr::Placement& placement,
                      const std::array<std::optional<glm::dvec3>, 2>& tips) {
    const std::size_t first = at_ ? at_->hand : 1;
    at_.reset();
    for (const std::size_t hand : {first, 1 - first}) {
        if (!drawn || !tips[hand]) continue;
        const auto index = pointAtTip(*drawn, placement, *tips[hand]);
        if (!index) continue;
        const std::uint64_t i = gridIndexOf(*drawn->placed, *index);
        search_.look(drawn->sorted, i, kPointsAFrame);
        at_ = At{hand, placeOf(*drawn, *index, i), search_.ended() ? Value::None : Value::Sought};
        if (const auto found = search_.found()) {
            at_->reading.value = drawn->sorted->value(*found);
            at_->value = Value::Found;
        }
        return;
    }
    search_ = {};  // holds no step in memory that nobody asks about
}

bool isInBox(const Drawn& drawn, const xr::Placement& placement, const glm::dvec3& tip) {
    return pointAtTip(drawn, placement, tip).has_value();
}

std::optional<Reading> readingAt(const Drawn& drawn, const xr::Placement& placement,
                                 const glm::dvec3& tip) {
    const auto index = pointAtTip(drawn, placement, tip);
    if (!index) return std::nullopt;
    const std::uint64_t i = gridIndexOf(*drawn.placed, *index);
    PointSearch search;
    search.look(drawn.sorted, i, drawn.sorted->size());
    if (!search.found()) return std::nullopt;
    Reading reading = placeOf(drawn, *index, i);
    reading.value = drawn.sorted->value(*search.found());
    return reading;
}

}  // namespace app::headset
