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
#include "render/splat/shaped_points-inl.h"

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

// The same of points of a mesh, as many as lanes or more times that; `level` is added to their
// third coordinates. Whether they are clipped is not asked.
HWY_ATTR void FindMeshDistances(const Distances& to,
                                std::span<const timeseries::Mesh::Point> points,
                                std::span<const double> level, std::span<double> away) {
    const hn::Rebind<std::uint32_t, Doubles> words;
    const auto none = hn::Set(words, timeseries::ShapedPoint::kNoPlace);
    for (std::size_t i = 0; i < points.size(); i += hn::Lanes(words)) {
        hn::Vec<decltype(words)> word[6];
        loadWords(words, points.data() + i, word);
        const D added[3] = {d(0), d(0), hn::LoadU(Doubles(), level.data() + i)};
        D square = hn::Zero(Doubles());
        for (std::size_t a = 0; a < 3; ++a) {
            const D at = hn::PromoteTo(Doubles(), placesOf(words, word[a]));
            const D x = hn::MulAdd(at, d(to.meshScale[a]), hn::Add(added[a], d(to.meshFrom[a])));
            square = hn::MulAdd(x, x, square);
        }
        const auto nowhere = hn::Eq(hn::And(word[0], none), none);
        const auto wide = hn::MaskFromVec(hn::BitCast(
            Doubles(),
            hn::PromoteTo(Longs(), hn::BitCast(HalfInts(), hn::VecFromMask(words, nowhere)))));
        hn::StoreU(hn::IfThenElse(wide, d(-1), hn::Sqrt(square)), Doubles(), away.data() + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(FindDistances);
HWY_EXPORT(FindMeshDistances);

Distances::Distances(const Scene& scene, const glm::dvec3& from)
    : placed_(scene.placed), clip_(scene.clip), from_(from) {
    const PlacedPoints& placed = scene.placed;
    if (placed.isMesh()) {
        takeMesh();
        return;
    }
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

void Distances::takeMesh() {
    clips = true;  // points without a place
    stored_ = placed_.mesh()->stored();
    const glm::dvec3 scale = placed_.scale() * stored_.unit,
                     origin = placed_.axesFromGrid(stored_.origin) - from_;
    for (std::size_t a = 0; a < 3; ++a) {
        meshScale[a] = scale[static_cast<int>(a)];
        meshFrom[a] = origin[static_cast<int>(a)];
    }
}

void Distances::findInMesh(std::span<const std::uint32_t> index,
                           std::span<const timeseries::Mesh::Point> points,
                           std::span<double> away) const {
    constexpr std::size_t kAtOnce = 64, kAhead = 16;
    std::array<timeseries::Mesh::Point, kAtOnce> some{};
    std::array<double, kAtOnce> level{}, found;
    const double levelScale = placed_.scale().z;
    const bool columns = !stored_.levels.empty(), holdsAll = clip_.holdsAll();
    for (std::size_t first = 0; first < index.size(); first += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, index.size() - first);
        for (std::size_t i = first; i < first + count; ++i) {
            if (points.empty() && i + kAhead < index.size()) placed_.prefetch(index[i + kAhead]);
            const std::size_t stored = stored_.points.size();
            some[i - first] = !points.empty()
                                  ? points[i]
                                  : stored_.points[columns ? index[i] % stored : index[i]];
            if (columns) level[i - first] = levelScale * stored_.levels[index[i] / stored].at;
        }
        HWY_DYNAMIC_DISPATCH(FindMeshDistances)(*this, some, level, found);
        for (std::size_t i = 0; i < count; ++i) {
            const bool isInside = holdsAll || placed_.inside(index[first + i], clip_);
            away[first + i] = isInside ? found[i] : -1;
        }
    }
}

void Distances::find(std::span<const std::uint32_t> index, std::span<double> away,
                     std::span<const timeseries::Mesh::Point> points) const {
    if (placed_.isMesh()) return findInMesh(index, points, away);
    HWY_DYNAMIC_DISPATCH(FindDistances)(*this, index, away);
}
}  // namespace render
#endif
