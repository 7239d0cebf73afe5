#include "render/splat/distances.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/splat/distances.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include "render/points/grid_indices-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE D distanceOf(const Distances& to, const std::uint32_t* index) {
    D at[3], along[3], square = hn::Zero(Doubles());
    alongAxes(to.size, index, at);
    positionsOf(to.position, at, along);
    for (std::size_t k = 0; k < 3; ++k) {
        const D x = hn::MulAdd(
            along[0], d(to.fromAxes[0][k]),
            hn::MulAdd(along[1], d(to.fromAxes[1][k]),
                       hn::MulAdd(along[2], d(to.fromAxes[2][k]), d(to.fromAxes[3][k]))));
        square = hn::MulAdd(x, x, square);
    }
    D away = hn::Sqrt(square);
    if (to.clips)
        for (std::size_t a = 0; a < 3; ++a) {
            const auto out = hn::Or(hn::Lt(at[a], d(to.clipLo[a])), hn::Gt(at[a], d(to.clipHi[a])));
            away = hn::IfThenElse(out, d(-1), away);
        }
    return away;
}

HWY_ATTR void FindDistances(const Distances& to, std::span<const std::uint32_t> index,
                            std::span<double> away) {
    constexpr std::size_t kLanes = hn::MaxLanes(Doubles());
    std::size_t i = 0;
    for (; i + kLanes <= index.size(); i += kLanes)
        hn::StoreU(distanceOf(to, index.data() + i), Doubles(), away.data() + i);
    if (i == index.size()) return;
    std::uint32_t last[kLanes] = {};
    double lastAway[kLanes];
    std::copy(index.begin() + static_cast<std::ptrdiff_t>(i), index.end(), last);
    hn::StoreU(distanceOf(to, last), Doubles(), lastAway);
    std::copy_n(lastAway, index.size() - i, away.begin() + static_cast<std::ptrdiff_t>(i));
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(FindDistances);

Distances::Distances(const Scene& scene, const glm::dvec3& from)
    : placed_(scene.placed), clip_(scene.clip), from_(from) {
    const PlacedPoints& placed = scene.placed;
    clips = placed.isMesh();
    if (clips) return;
    for (int a = 0; a < 3; ++a) {
        const auto k = static_cast<std::size_t>(a);
        size[k] = placed.size()[a];
        position[k] = placed.positions()[k].data();
        for (int row = 0; row < 3; ++row)
            fromAxes[k][static_cast<std::size_t>(row)] = placed.worldFromAxes()[a][row];
        fromAxes[3][k] = -from[a];
        clipLo[k] = scene.clip.lo[a];
        clipHi[k] = scene.clip.hi[a];
        clips = clips || clipLo[k] > 0 || clipHi[k] + 1 < size[k];
    }
}

void Distances::findInMesh(std::span<const std::uint32_t> index,
                           std::span<const timeseries::Mesh::Point> points,
                           std::span<double> away) const {
    constexpr std::size_t kAhead = 16;
    const bool holdsAll = clip_.holdsAll();
    for (std::size_t i = 0; i < index.size(); ++i) {
        if (points.empty() && i + kAhead < index.size()) placed_.prefetch(index[i + kAhead]);
        away[i] = -1;
        if (!holdsAll && !placed_.inside(index[i], clip_)) continue;
        const glm::dvec3 at =
            points.empty() ? placed_.position(index[i]) : placed_.position(points[i], index[i]);
        const double distance = glm::distance(at, from_);
        if (std::isfinite(distance)) away[i] = distance;
    }
}

void Distances::find(std::span<const std::uint32_t> index, std::span<double> away,
                     std::span<const timeseries::Mesh::Point> points) const {
    if (placed_.isMesh()) return findInMesh(index, points, away);
    HWY_DYNAMIC_DISPATCH(FindDistances)(*this, index, away);
}
}  // namespace render
#endif
