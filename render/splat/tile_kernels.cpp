#include "render/splat/tile_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/splat/tile_kernels.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include "render/splat/tile_pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// No point that is drawn is lost by arithmetic in float: these are a little wider.
HWY_INLINE hn::Mask<Floats> roughlyDrawn(const TileView& view, const Points& p) {
    const Ints ints;
    auto drawn = hn::And(hn::Gt(p.depth, f(view.near * 0.999f)), hn::Le(p.windowDepth, f(1.001f)));
    if (view.clips)
        for (std::size_t a = 0; a < 3; ++a) {
            const auto out = hn::Or(hn::Lt(p.at[a], hn::Set(ints, view.clipLo[a])),
                                    hn::Gt(p.at[a], hn::Set(ints, view.clipHi[a])));
            drawn = hn::AndNot(hn::RebindMask(Floats(), out), drawn);
        }
    return drawn;
}

HWY_ATTR void FindTiles(const TileView& view, const SplatList& list, std::size_t first,
                        std::size_t last, std::span<TileSpan> spans) {
    const Ints ints;
    alignas(64) std::uint32_t some[kLanes];
    alignas(64) std::int32_t from[2][kLanes], to[2][kLanes];
    for (std::size_t i = first; i < last; i += kLanes) {
        const std::size_t count = std::min(kLanes, last - i);
        for (std::size_t k = 0; k < kLanes; ++k) some[k] = list.index[i + std::min(k, count - 1)];
        const Points p = seeRoughly(view, some);
        const auto drawn = roughlyDrawn(view, p);
        const F reach = hn::Add(
            view.pointSide > 0 ? f(0.5f * static_cast<float>(view.pointSide)) : extent(view, p),
            f(1));
        for (int k = 0; k < 2; ++k) {
            const F perTile = f(1 / static_cast<float>(view.tile[k]));
            const F tiles = f(static_cast<float>(view.tiles[k]));
            const F begin = hn::Floor(hn::Mul(hn::Sub(p.window[k], reach), perTile));
            const F end = hn::Ceil(hn::Mul(hn::Add(p.window[k], reach), perTile));
            const auto within = [&](F tile) HWY_ATTR {
                return hn::IfThenElseZero(drawn, hn::Min(hn::Max(tile, hn::Zero(Floats())), tiles));
            };
            hn::Store(hn::ConvertTo(ints, within(begin)), ints, from[k]);
            hn::Store(hn::ConvertTo(ints, within(end)), ints, to[k]);
        }
        for (std::size_t k = 0; k < count; ++k) {
            const int columns = to[0][k] - from[0][k], rows = to[1][k] - from[1][k];
            TileSpan& span = spans[i + k] = {};
            if (columns <= 0 || rows <= 0) continue;
            span = {static_cast<std::uint32_t>(from[1][k] * view.tiles.x + from[0][k]),
                    static_cast<std::uint16_t>(columns), static_cast<std::uint16_t>(rows)};
        }
    }
}

HWY_ATTR void SumTile(const TileView& view, std::span<const std::uint32_t> index,
                      std::span<const float> tints, TileRoom& room) {
    Batch batch;
    alignas(64) std::uint32_t lastIndex[kLanes];
    alignas(64) float lastTints[kLanes];
    for (std::size_t i = 0; i < index.size(); i += kLanes) {
        const std::size_t count = std::min(kLanes, index.size() - i);
        const std::uint32_t* someIndex = index.data() + i;
        const float* someTints = tints.empty() ? nullptr : tints.data() + i;
        if (count < kLanes) {
            for (std::size_t k = 0; k < kLanes; ++k) {
                const std::size_t from = i + std::min(k, count - 1);
                lastIndex[k] = index[from];
                lastTints[k] = tints.empty() ? 0 : tints[from];
            }
            someIndex = lastIndex;
            if (!tints.empty()) someTints = lastTints;
        }
        setUp(view, someIndex, someTints, room.at, room.size, batch);
        for (std::size_t k = 0; k < count; ++k) {
            if (batch.columns[k] <= 0) continue;
            if (batch.columns[k] <= 8)
                addSplat(FewFloats(), view, batch, k, room);
            else
                addSplat(Floats(), view, batch, k, room);
        }
    }
}

// |ray| times what even splats share, and 1 / |ray / a|^2 of those.
HWY_ATTR void FillRays(const TileView& view, TileRoom& room) {
    const Floats lanes;
    const F steps = hn::ConvertTo(lanes, hn::Iota(Ints(), 0));
    F most = hn::Zero(lanes);
    for (int row = 0; row < room.size.y; ++row) {
        const double y = room.at.y + row + 0.5 - view.centre[1];
        const F ray0 = f(static_cast<float>(1 + static_cast<double>(view.slope2[1]) * y * y));
        for (int i = 0; i < kTileStride; i += static_cast<int>(kLanes)) {
            const F x = hn::Add(f(static_cast<float>(room.at.x + i + 0.5 - view.centre[0])), steps);
            F factor = hn::Sqrt(hn::MulAdd(hn::Mul(f(view.slope2[0]), x), x, ray0));
            const auto at = static_cast<std::size_t>(row * kTileStride + i);
            if (view.even) {
                F sum = hn::Zero(lanes);
                for (std::size_t a = 0; a < 3; ++a) {
                    const auto atY = static_cast<float>(view.axis[a] +
                                                        y * static_cast<double>(view.perPixelY[a]));
                    const F ray = hn::Mul(hn::MulAdd(x, f(view.perPixelX[a]), f(atY)),
                                          f(1 / view.semiAxes[a]));
                    sum = hn::MulAdd(ray, ray, sum);
                }
                const F perRay2 = hn::Div(f(1), sum);
                hn::StoreU(perRay2, lanes, room.perRay2.data() + at);
                factor = hn::Mul(factor, hn::Sqrt(perRay2));
            }
            hn::StoreU(factor, lanes, room.factor.data() + at);
            most = hn::Max(most, factor);
        }
    }
    room.largestFactor = hn::GetLane(hn::MaxOfLanes(lanes, most));
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(FindTiles);
HWY_EXPORT(FillRays);
HWY_EXPORT(SumTile);

void findTiles(const TileView& view, const SplatList& list, std::size_t first, std::size_t last,
               std::span<TileSpan> spans) {
    HWY_DYNAMIC_DISPATCH(FindTiles)(view, list, first, last, spans);
}

TileRoom::TileRoom(const TileView& view) {
    plane = static_cast<std::size_t>(kTileStride * view.tile.y) + 16;
    sums.resize(plane * floatsPerPixel(view.channels));
    factor.resize(plane);
    perRay2.resize(plane);
    opaque.resize(plane);
}

void TileRoom::enter(const TileView& view, std::size_t tile, std::span<const float> opaqueDepth,
                     int pictureWidth) {
    at = cornerOf(view, tile);
    size = glm::min(view.tile, view.box.size - at);
    nearestOpaque = 1;
    if (!opaqueDepth.empty())
        for (int row = 0; row < size.y; ++row) {
            const auto from = opaqueDepth.begin() +
                              std::ptrdiff_t(view.box.at.y + at.y + row) * pictureWidth +
                              view.box.at.x + at.x;
            const auto to = opaque.begin() + row * kTileStride;
            std::copy_n(from, size.x, to);
            nearestOpaque = std::min(nearestOpaque, *std::min_element(to, to + size.x));
        }
    HWY_DYNAMIC_DISPATCH(FillRays)(view, *this);
}

void sumTile(const TileView& view, std::span<const std::uint32_t> index,
             std::span<const float> tints, TileRoom& room) {
    HWY_DYNAMIC_DISPATCH(SumTile)(view, index, tints, room);
}
}  // namespace render
#endif
