#include "render/splat/window_box.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>

#include "render/model/seen_bounds.h"

namespace render {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr WindowBox kNothing{glm::dvec2(kFar), glm::dvec2(-kFar)};
constexpr WindowBox kEverything{glm::dvec2(-kFar), glm::dvec2(kFar)};

}  // namespace

WindowBox windowBox(const PointsView& view, std::span<const glm::dvec3> corners) {
    constexpr std::size_t kMost = 8;
    assert(corners.size() <= kMost);
    std::array<glm::dvec3, kMost> seen;
    std::ranges::transform(corners, seen.begin(), [&](const glm::dvec3& corner) {
        return glm::dvec3(view.viewFromAxes * glm::dvec4(corner, 1.0));
    });
    SeenBounds bounds(view.rays);
    bounds.takeHull(std::span(seen).first(corners.size()));
    return {view.rays.centre + bounds.lo(), view.rays.centre + bounds.hi()};
}

ReachBox::ReachBox(const PointsView& view, const glm::dvec3& reach) : view_(view) {
    const glm::dmat3 turned(view.viewFromAxes);
    for (int a = 0; a < 3; ++a) reach_ += glm::abs(turned[a]) * reach[a];
}

WindowBox ReachBox::operator()(const glm::dvec3& place) const {
    const glm::dvec3 seen(view_.viewFromAxes * glm::dvec4(place, 1.0));
    const double nearest = -seen.z - reach_.z, farthest = -seen.z + reach_.z;
    if (farthest <= view_.rays.near) return kNothing;
    if (!(nearest > view_.rays.near)) return kEverything;  // also where the reach is infinite
    WindowBox box{};
    for (int a = 0; a < 2; ++a) {
        const double lo = seen[a] - reach_[a], hi = seen[a] + reach_[a];
        box.lo[a] = view_.rays.centre[a] + view_.rays.focal[a] * lo / (lo < 0 ? nearest : farthest);
        box.hi[a] = view_.rays.centre[a] + view_.rays.focal[a] * hi / (hi < 0 ? farthest : nearest);
    }
    return box;
}

}  // namespace render
