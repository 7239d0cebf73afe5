#include "render/splat/tile_kernels.h"

#include <algorithm>
#include <cmath>

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
        F lo[2], hi[2];
        lo[0] = lo[1] = f(-0.5f * static_cast<float>(view.pointSide));
        hi[0] = hi[1] = f(0.5f * static_cast<float>(view.pointSide));
        if (view.pointSide == 0) extentsOf(view, p, lo, hi);
        for (int k = 0; k < 2; ++k) {
            const F perTile = f(1 / static_cast<float>(view.tile[k]));
            const F tiles = f(static_cast<float>(view.tiles[k]));
            const auto at = [&](F offset, float more) HWY_ATTR {
                return hn::Mul(hn::Add(hn::Add(p.window[k], offset), f(more)), perTile);
            };
            const F begin = hn::Floor(at(lo[k], -1)), end = hn::Ceil(at(hi[k], 1));
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
        if (view.channels == Channels::Over && i % kBetweenLooks == 0 && room.isClosed()) return;
        const std::size_t count = std::min(kLanes, index.size() - i);
        if (!view.meshSplats.empty())  // the next ones, which lie anywhere
            for (std::size_t k = i + kLanes; k < std::min(i + 2 * kLanes, index.size()); ++k)
                __builtin_prefetch(&view.meshSplats[index[k]]);
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

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(FindTiles);
HWY_EXPORT(SumTile);

void findTiles(const TileView& view, const SplatList& list, std::size_t first, std::size_t last,
               std::span<TileSpan> spans) {
    HWY_DYNAMIC_DISPATCH(FindTiles)(view, list, first, last, spans);
}

void sumTile(const TileView& view, std::span<const std::uint32_t> index,
             std::span<const float> tints, TileRoom& room) {
    HWY_DYNAMIC_DISPATCH(SumTile)(view, index, tints, room);
}
}  // namespace render
#endif
