#include "render/splat/tile_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

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

// Those of a vector's points.
HWY_INLINE void findSome(const TileView& view, std::uint32_t* points, TileSpan* spans) {
    const Ints ints;
    const Points p = seeRoughly(view, points);
    if (view.packs) pack(view, p.at, points);
    const auto drawn = roughlyDrawn(view, p);
    F lo[2], hi[2];
    lo[0] = lo[1] = f(-0.5f * static_cast<float>(view.pointSide));
    hi[0] = hi[1] = f(0.5f * static_cast<float>(view.pointSide));
    if (view.pointSide == 0) extentsOf(view, p, lo, hi);
    I first[2], count[2];
    for (std::size_t k = 0; k < 2; ++k) {
        const auto at = static_cast<int>(k);
        const F perTile = f(1 / static_cast<float>(view.tile[at]));
        const F tiles = f(static_cast<float>(view.tiles[at]));
        const auto within = [&](F offset) HWY_ATTR {
            const F tile = hn::Mul(hn::Add(p.window[k], offset), perTile);
            return hn::IfThenElseZero(drawn, hn::Min(hn::Max(tile, hn::Zero(Floats())), tiles));
        };
        first[k] = hn::ConvertTo(ints, hn::Floor(within(hn::Sub(lo[k], f(1)))));
        count[k] = hn::Sub(hn::ConvertTo(ints, hn::Ceil(within(hn::Add(hi[k], f(1))))), first[k]);
    }
    const auto any = hn::And(hn::Gt(count[0], hn::Zero(ints)), hn::Gt(count[1], hn::Zero(ints)));
    const I size = hn::IfThenElseZero(any, hn::Or(count[0], hn::ShiftLeft<16>(count[1])));
    const I tile = hn::Add(hn::Mul(first[1], hn::Set(ints, view.tiles.x)), first[0]);
    hn::StoreInterleaved2(tile, size, ints, reinterpret_cast<std::int32_t*>(spans));
}
static_assert(sizeof(TileSpan) == 8 && offsetof(TileSpan, columns) == 4 &&
              offsetof(TileSpan, rows) == 6 && std::endian::native == std::endian::little);

HWY_ATTR void FindTiles(const TileView& view, std::span<std::uint32_t> points,
                        std::span<TileSpan> spans) {
    std::size_t i = 0;
    for (; i + kLanes <= points.size(); i += kLanes) findSome(view, &points[i], &spans[i]);
    if (i == points.size()) return;
    std::uint32_t last[kLanes];
    TileSpan lastSpans[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) last[k] = points[std::min(i + k, points.size() - 1)];
    findSome(view, last, lastSpans);
    std::copy_n(last, points.size() - i, &points[i]);
    std::copy_n(lastSpans, points.size() - i, &spans[i]);
}

template <Channels kChannels, Shape kShape>
HWY_INLINE void sumOf(const TileView& view, std::span<const std::uint32_t> words,
                      std::span<const float> tints, TileRoom& room) {
    Batch batch;
    alignas(64) std::uint32_t last[kLanes];
    alignas(64) float lastTints[kLanes];
    for (std::size_t i = 0; i < words.size(); i += kLanes) {
        if (kChannels == Channels::Over && i % kBetweenLooks == 0 && room.isClosed()) return;
        const std::size_t count = std::min(kLanes, words.size() - i);
        if (mayBeSeenBefore(kShape) && view.isSeenBefore)  // the next, which lie anywhere
            for (std::size_t k = i + kLanes; k < std::min(i + 2 * kLanes, words.size()); ++k)
                __builtin_prefetch(&view.seenSplats[words[k]]);
        const std::uint32_t* some = words.data() + i;
        const float* someTints = tints.empty() ? nullptr : tints.data() + i;
        if (count < kLanes) {
            for (std::size_t k = 0; k < kLanes; ++k) {
                const std::size_t from = i + std::min(k, count - 1);
                last[k] = words[from];
                lastTints[k] = tints.empty() ? 0 : tints[from];
            }
            some = last;
            if (!tints.empty()) someTints = lastTints;
        }
        setUp<kShape>(view, some, someTints, room.at, room.size, batch);
        if constexpr (kChannels == Channels::Over) setUpDepth<kShape>(room, batch);
        for (std::size_t k = 0; k < count; ++k) {
            if (batch.columns[k] <= 0) continue;
            if (batch.columns[k] <= 8)
                addSplat<kChannels, kShape>(FewFloats(), batch, k, room);
            else
                addSplat<kChannels, kShape>(Floats(), batch, k, room);
        }
    }
}

template <Channels kChannels>
HWY_INLINE void sumOf(const TileView& view, std::span<const std::uint32_t> words,
                      std::span<const float> tints, TileRoom& room) {
    if (view.pointSide > 0) return sumOf<kChannels, Shape::Square>(view, words, tints, room);
    if (view.spheres) return sumOf<kChannels, Shape::Sphere>(view, words, tints, room);
    if (view.even) return sumOf<kChannels, Shape::Even>(view, words, tints, room);
    if (view.endsAtFaces) return sumOf<kChannels, Shape::Cut>(view, words, tints, room);
    sumOf<kChannels, Shape::Uneven>(view, words, tints, room);
}

HWY_ATTR void SumTile(const TileView& view, std::span<const std::uint32_t> words,
                      std::span<const float> tints, TileRoom& room) {
    switch (view.channels) {
        case Channels::Weight:
            return sumOf<Channels::Weight>(view, words, tints, room);
        case Channels::WeightedColor:
            return sumOf<Channels::WeightedColor>(view, words, tints, room);
        case Channels::Over:
            return sumOf<Channels::Over>(view, words, tints, room);
        case Channels::Count:
            return sumOf<Channels::Count>(view, words, tints, room);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(FindTiles);
HWY_EXPORT(SumTile);

void findTiles(const TileView& view, std::span<std::uint32_t> points, std::span<TileSpan> spans) {
    HWY_DYNAMIC_DISPATCH(FindTiles)(view, points, spans);
}

void sumTile(const TileView& view, std::span<const std::uint32_t> points,
             std::span<const float> tints, TileRoom& room) {
    HWY_DYNAMIC_DISPATCH(SumTile)(view, points, tints, room);
}
}  // namespace render
#endif
