#include "render/splat/tet_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/splat/tet_kernels.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include "render/splat/cell_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = Floats;
using V = hn::Vec<Lanes>;

HWY_INLINE V set(float x) { return hn::Set(Lanes(), x); }

// What rays of a vector of pixels have in a tetrahedron. Names as in fragmentOn().
struct Way {
    V from, to;
};
HWY_INLINE Way wayThrough(const SeenTet& c, V ox, V oy, V near, V opaque) {
    Way way{near, opaque};
    const V far = set(3e38f), least = set(static_cast<float>(kLeastStep)), zero = set(0);
    for (std::size_t i = 0; i < 4; ++i) {
        const V shift = hn::MulAdd(ox, set(c.right[i]), hn::Mul(oy, set(c.up[i])));
        const V at = hn::MulAdd(set(c.base), shift, set(c.at[i]));
        const V along = hn::Add(set(c.ray[i]), shift);
        const V step = hn::CopySign(hn::Max(hn::Abs(along), least), along);
        const V where = hn::Neg(hn::Mul(at, reciprocal(Lanes(), step)));
        const auto enters = hn::Gt(step, zero);
        way.from = hn::Max(way.from, hn::IfThenElse(enters, where, hn::Neg(far)));
        way.to = hn::Min(way.to, hn::IfThenElse(enters, far, where));
    }
    return way;
}

// Light on a tetrahedron.
struct TetLight {
    LightLanes<Lanes> light;
    const TetSlopes& slopes;
    V right[3], up[3];  // of the way of a ray, a pixel
    TetLight(const CellView& view, const TetSlopes& of)
        : light(Lanes(), view, of.steep, {1, 1, 1}), slopes(of) {
        for (std::size_t a = 0; a < 3; ++a) {
            right[a] = set(view.perPixelX[a]);
            up[a] = set(view.perPixelY[a]);
        }
    }
    // At a depth from the base, on rays of such pixels.
    HWY_INLINE void shade(V ox, V oy, V base, V depth, V factor, V& diffuse, V& specular) const {
        V g[3], way[3], change = set(0);
        for (std::size_t a = 0; a < 3; ++a) {
            const TetSlopes::Along& f = slopes.along[a];
            const V shift = hn::MulAdd(ox, set(f.right), hn::Mul(oy, set(f.up)));
            const V at = hn::MulAdd(base, shift, set(f.at));
            g[a] = hn::MulAdd(depth, hn::Add(set(f.ray), shift), at);
            way[a] = hn::MulAdd(ox, right[a], hn::MulAdd(oy, up[a], set(slopes.way[a])));
            change = hn::MulAdd(g[a], way[a], change);
        }
        if (light.view.lamp)
            light.template shade<Lit::FromLamp>(g, change, way, factor, diffuse, specular);
        else
            light.template shade<Lit::FromEye>(g, change, way, factor, diffuse, specular);
    }
};

// `slopes`: null where no light falls on it.
template <Channels kChannels, bool kByValue, int kEnds>
HWY_INLINE void addTet(const CellView& view, const SeenTet& c, const TetSlopes* slopes,
                       TileRoom& room) {
    constexpr bool kColors = kChannels == Channels::WeightedColor || kChannels == Channels::Over;
    constexpr PixelBlock<Lanes, kTileStride> pixels;
    constexpr int kColumns = static_cast<int>(pixels.kColumns);
    constexpr int kRows = static_cast<int>(pixels.kRows);
    const Lanes lanes;
    const glm::ivec2 least = glm::max(glm::ivec2(c.x, c.y), room.at);
    const glm::ivec2 most =
        glm::min(glm::ivec2(c.x + c.columns(), c.y + c.rows()), room.at + room.size);
    [[maybe_unused]] const auto color = [&] {
        if constexpr (kColors)
            return ColorLanes<kByValue, Lanes>(lanes, view, c);
        else
            return 0;
    }();
    float scale = view.weight;
    if constexpr (kColors) scale *= color.weight;
    const V weight = set(scale), perRange = set(scale / view.weight * c.perRange);
    const bool hides = room.nearestOpaque < 1;
    const V depthA = set(static_cast<float>(view.depthA));
    const V depthB = set(static_cast<float>(view.depthB));
    const V base = set(c.base), near = set(view.near - c.base), half = set(0.5f);
    const V stepsX = pixels.columns(lanes), stepsY = pixels.rows(lanes);
    for (int y = least.y; y < most.y; y += kRows) {
        const V oy = hn::Add(set(c.oy + static_cast<float>(y - c.y)), stepsY);
        for (int x = least.x; x < most.x; x += kColumns) {
            const V ox = hn::Add(set(c.ox + static_cast<float>(x - c.x)), stepsX);
            const auto at = static_cast<std::size_t>((y - room.at.y) * kTileStride + x - room.at.x);
            V opaque = set(3e38f);
            if (hides) {
                const V depth = pixels.load(lanes, room.opaque.data() + at);
                opaque = hn::Sub(hn::Div(depthA, hn::Sub(depth, depthB)), base);
            }
            const Way way = wayThrough(c, ox, oy, near, opaque);
            const auto inside = hn::Gt(way.to, way.from);
            if (hn::AllFalse(lanes, inside)) continue;
            const V length = hn::Sub(way.to, way.from);
            V t = hn::Mul(weight, length);
            const V shift = hn::MulAdd(ox, set(c.fRight), hn::Mul(oy, set(c.fUp)));
            const V change = hn::Add(set(c.fRay), shift);
            const V middle = hn::Mul(half, hn::Add(way.from, way.to));
            const V value =
                hn::MulAdd(middle, change, hn::MulAdd(base, shift, set(c.f)));  // half way through
            const V reach = hn::Mul(half, hn::Mul(length, change));
            V front = hn::Sub(value, reach), back = hn::Add(value, reach), whole = t;
            const V factor = pixels.load(lanes, room.factor.data() + at);
            if constexpr (kEnds > 0) {
                const V first = front, last = back;
                const V width = hn::Min(hn::Max(hn::Mul(hn::Add(base, middle), set(c.across)),
                                                set(static_cast<float>(2 * kLeastChange))),
                                        set(c.widest));
                // As if along the view axis: the ray's own length is a factor later.
                if (c.perRange > 0)
                    whole = hn::Max(t, hn::Mul(hn::Mul(perRange, reciprocal(lanes, factor)),
                                               hn::Abs(hn::Sub(last, first))));
                const RangeLanes<Lanes, kEnds> range(lanes, c);
                V before[kEnds];
                range.ramps(width, before);
                const V perWidth = reciprocal(lanes, width);
                const auto share = range.template share<kByValue>(
                    first, last, range.template passed<kByValue>(first, before, width),
                    range.template passed<kByValue>(last, before, width), perWidth);
                t = hn::Mul(whole, hn::Max(share.is, set(0)));
                if constexpr (kByValue) {
                    V low, high;
                    range.ends(first, last, width, low, high);
                    const V mean = range.meanValue(share.above, share.is, perWidth);
                    const V aside = hn::CopySign(
                        hn::Max(hn::Min(hn::Sub(mean, low), hn::Sub(high, mean)), set(0)), change);
                    front = hn::Sub(mean, aside);
                    back = hn::Add(mean, aside);
                }
            }
            if constexpr (kByValue && kChannels == Channels::Over)
                back = seenTo(lanes, front, back, hn::Mul(t, factor), hn::Mul(whole, factor),
                              hn::Add(reach, reach));
            t = hn::IfThenElseZero(inside, t);
            addWeight<kChannels>(pixels, lanes, t, room, at, [&](V* colors) HWY_ATTR {
                if constexpr (kColors) color.between(front, back, colors);
                if (slopes == nullptr) return;
                V diffuse, specular;
                const V depth =
                    hn::Add(middle, inRange(lanes, c, value, change, length, hn::Mul(t, factor)));
                TetLight(view, *slopes).shade(ox, oy, base, depth, factor, diffuse, specular);
                for (int k = 0; k < 3; ++k) colors[k] = hn::MulAdd(colors[k], diffuse, specular);
            });
        }
    }
}

template <Channels kChannels, bool kByValue>
HWY_INLINE void addTets(const CellView& view, const SeenTets& seen,
                        std::span<const std::uint32_t> which, TileRoom& room) {
    const std::vector<SeenTet>& tets = seen.tets;
    const bool isLit = kChannels == Channels::Over && view.light != Light::Off;
    for (std::size_t i = 0; i < which.size(); ++i) {
        if (kChannels == Channels::Over && i % kBetweenLooks == 0 && room.isClosed()) return;
        const std::size_t ahead = which[std::min(i + kAhead, which.size() - 1)];
        prefetch(tets[ahead]);
        if (isLit) prefetch(seen.slopes[ahead]);
        const SeenTet& c = tets[which[i]];
        const TetSlopes* const slopes = isLit ? &seen.slopes[which[i]] : nullptr;
        switch (int{c.crossesLeast()} + int{c.crossesMost()}) {
            case 0:
                addTet<kChannels, kByValue, 0>(view, c, slopes, room);
                break;
            case 1:
                addTet<kChannels, kByValue, 1>(view, c, slopes, room);
                break;
            default:
                addTet<kChannels, kByValue, 2>(view, c, slopes, room);
        }
    }
}

HWY_ATTR void SumTets(const CellView& view, const SeenTets& tets,
                      std::span<const std::uint32_t> which, TileRoom& room) {
    switch (view.channels) {
        case Channels::Weight:
            return addTets<Channels::Weight, false>(view, tets, which, room);
        case Channels::Count:
            return addTets<Channels::Count, false>(view, tets, which, room);
        case Channels::WeightedColor:
            return view.byValue ? addTets<Channels::WeightedColor, true>(view, tets, which, room)
                                : addTets<Channels::WeightedColor, false>(view, tets, which, room);
        case Channels::Over:
            return view.byValue ? addTets<Channels::Over, true>(view, tets, which, room)
                                : addTets<Channels::Over, false>(view, tets, which, room);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(SumTets);

void sumTets(const CellView& view, const SeenTets& tets, std::span<const std::uint32_t> which,
             TileRoom& room) {
    HWY_DYNAMIC_DISPATCH(SumTets)(view, tets, which, room);
}
}  // namespace render
#endif
