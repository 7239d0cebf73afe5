#include "app/headset/tip_probe.h"

#include <algorithm>
#include <cmath>
#include <functional>
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
            .step = drawn.step};
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
        const double reach = half > 0 ? half : 0.5 * placed.widths()[axis][0];
        if (!(std::abs(place[a]) <= reach)) return std::nullopt;
        index[axis] = nearest(placed.positions()[axis], place[a]);
    }
    return index;
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
