// What a cell adds to the pixels of a tile. Compiled once for each of Highway's targets, so not
// guarded as other headers are.
#if defined(RENDER_CELL_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_CELL_PIXELS_INL_H_
#undef RENDER_CELL_PIXELS_INL_H_
#else
#define RENDER_CELL_PIXELS_INL_H_
#endif

#include <algorithm>

#include "render/splat/cell_range-inl.h"
#include "render/splat/cell_view.h"
#include "render/splat/tile_room.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// What rays of a vector of pixels have in a cell, in its units. Names as in fragmentOn().
template <class Lanes>
struct RayParts {
    using V = hn::Vec<Lanes>;
    V length, depth;  // of the way through it, and where its middle is
    V middle[3], along[3], mixed[3], gradient[3], value;
};

// A cell's numbers, the same in every lane.
template <class Lanes>
struct CellLanes {
    using V = hn::Vec<Lanes>;
    Lanes lanes;
    V base, before, at[3], ray[3], x[3], y[3], f[8];
    bool grazes;
    CellLanes(Lanes l, const CellView& view, const SeenCell& c)
        : lanes(l),
          base(hn::Set(l, c.base)),
          before(hn::Set(l, c.base - view.near)),
          grazes(c.grazes) {
        for (std::size_t a = 0; a < 3; ++a) {
            at[a] = hn::Set(l, c.at[a]);
            ray[a] = hn::Set(l, c.ray[a]);
            x[a] = hn::Set(l, view.perPixelX[a] * c.perSize[a]);
            y[a] = hn::Set(l, view.perPixelY[a] * c.perSize[a]);
        }
        for (std::size_t k = 0; k < 8; ++k) f[k] = hn::Set(l, c.f[k]);
    }

    // Where rays at these offsets are inside, as far as `beyond`.
    HWY_INLINE void meet(V ox, V oy, V beyond, RayParts<Lanes>& r) const {
        const V half = hn::Set(lanes, 0.5f);
        V front = before, back = beyond;  // from where places are counted, towards the eye and away
        for (std::size_t a = 0; a < 3; ++a) {
            const V shift = hn::MulAdd(ox, x[a], hn::Mul(oy, y[a]));
            r.middle[a] = hn::MulAdd(base, shift, at[a]);  // of the ray at the base, as yet
            r.along[a] = hn::Add(ray[a], shift);
            V step = r.along[a];
            if (grazes) {
                const V least = hn::Set(lanes, static_cast<float>(kLeastStep));
                step = hn::CopySign(hn::Max(hn::Abs(step), least), step);
            }
            const V per = reciprocal(lanes, step), way = hn::Mul(half, hn::Abs(per));
            front = hn::Min(front, hn::MulAdd(r.middle[a], per, way));
            back = hn::Min(back, hn::NegMulAdd(r.middle[a], per, way));
        }
        r.length = hn::Add(front, back);
        r.depth = hn::Mul(half, hn::Sub(back, front));
    }
    // The field half way through, and how it changes there.
    HWY_INLINE void lookHalfWay(RayParts<Lanes>& r) const {
        for (std::size_t a = 0; a < 3; ++a)
            r.middle[a] = hn::MulAdd(r.depth, r.along[a], r.middle[a]);
        const V* m = r.middle;
        for (std::size_t a = 0; a < 3; ++a) r.mixed[a] = hn::MulAdd(f[7], m[a], f[6 - a]);
        r.gradient[0] = hn::MulAdd(r.mixed[2], m[1], hn::MulAdd(f[5], m[2], f[1]));
        r.gradient[1] = hn::MulAdd(r.mixed[2], m[0], hn::MulAdd(f[6], m[2], f[2]));
        r.gradient[2] = hn::MulAdd(r.mixed[1], m[0], hn::MulAdd(f[6], m[1], f[3]));
        const V slice =
            hn::MulAdd(m[1], hn::MulAdd(f[4], m[0], f[2]), hn::MulAdd(f[1], m[0], f[0]));
        r.value = hn::MulAdd(m[2], r.gradient[2], slice);
    }
    // The field at the ends of its pieces.
    HWY_INLINE void follow(const RayParts<Lanes>& r, V* values) const {
        static_assert(kPieces == 3);
        const V half = hn::Mul(hn::Set(lanes, 0.5f), r.length);
        V d[3];  // half of the way
        for (std::size_t a = 0; a < 3; ++a) d[a] = hn::Mul(half, r.along[a]);
        const V xy = hn::Mul(d[0], d[1]);
        const V mixed = hn::MulAdd(d[0], r.mixed[1], hn::Mul(d[1], r.mixed[0]));
        const V first = dot(r.gradient, d);
        const V second = hn::MulAdd(xy, r.mixed[2], hn::Mul(d[2], mixed));
        const V third = hn::Mul(hn::Mul(xy, d[2]), f[7]);
        const auto ends = [&](float way, V& before, V& after) HWY_ATTR {
            const V even = hn::MulAdd(hn::Set(lanes, way * way), second, r.value);
            const V odd = hn::Mul(hn::Set(lanes, way),
                                  hn::MulAdd(hn::Set(lanes, way * way), third, first));
            before = hn::Sub(even, odd);
            after = hn::Add(even, odd);
        };
        ends(1, values[0], values[3]);
        ends(1 / 3.0f, values[1], values[2]);
    }
    // The width of the ramp that a pixel makes of an end of the range, and its reciprocal.
    HWY_INLINE void acrossPixel(const RayParts<Lanes>& r, V& width, V& perWidth) const {
        constexpr float kLeast = static_cast<float>(2 * kLeastChange);
        const V alongX = dot(r.gradient, x), alongY = dot(r.gradient, y);
        const V depth = hn::Add(base, r.depth);
        const V change2 = hn::Mul(hn::Mul(depth, depth),
                                  hn::MulAdd(alongX, alongX, hn::Mul(alongY, alongY)));
        const V width2 = hn::Max(change2, hn::Set(lanes, kLeast * kLeast));
        perWidth = reciprocalRoot(lanes, width2);
        width = hn::Mul(width2, perWidth);
    }
    HWY_INLINE V dot(const V* a, const V* b) const {
        return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
    }
};

// What light makes of a colour. At the pixels that begin at `at`, whose rays are `factor` times as
// long as the view axis'.
template <class Lanes>
struct LightLanes {
    using V = hn::Vec<Lanes>;
    Lanes lanes;
    V perSize[3], metric[6], steep, perUnit;
    Light light;
    LightLanes(Lanes l, const CellView& view, const SeenCell& c)
        : lanes(l),
          steep(hn::Set(l, c.steep)),
          perUnit(hn::Set(l, 1 / view.rayLength)),
          light(view.light) {
        for (std::size_t a = 0; a < 3; ++a) perSize[a] = hn::Set(l, c.perSize[a]);
        for (std::size_t k = 0; k < 6; ++k) metric[k] = hn::Set(l, view.metric[k]);
    }
    HWY_INLINE void shade(const RayParts<Lanes>& r, V change, V factor, V& diffuse,
                          V& specular) const {
        const V one = hn::Set(lanes, 1.0f), tiny = hn::Set(lanes, 1e-30f);
        V g[3];
        for (std::size_t a = 0; a < 3; ++a) g[a] = hn::Mul(r.gradient[a], perSize[a]);
        V g2 = hn::Mul(hn::Mul(metric[0], g[0]), g[0]);
        g2 = hn::MulAdd(hn::Mul(metric[1], g[1]), g[1], g2);
        g2 = hn::MulAdd(hn::Mul(metric[2], g[2]), g[2], g2);
        g2 = hn::MulAdd(hn::Mul(metric[3], g[0]), g[1], g2);
        g2 = hn::MulAdd(hn::Mul(metric[4], g[0]), g[2], g2);
        g2 = hn::MulAdd(hn::Mul(metric[5], g[1]), g[2], g2);
        const V per = reciprocalRoot(lanes, hn::Max(g2, tiny));
        const V certainty = reciprocal(lanes, hn::MulAdd(steep, per, one));
        const V facing = hn::Min(one, hn::Mul(hn::Mul(hn::Abs(change), per),
                                              hn::Mul(perUnit, reciprocal(lanes, factor))));
        lightOf(lanes, light, certainty, facing, diffuse, specular);
    }
};

template <Channels kChannels, bool kByValue, bool kLit, int kEnds, class Lanes>
HWY_INLINE void addCell(Lanes lanes, const CellView& view, const SeenCell& c, TileRoom& room) {
    using V = hn::Vec<Lanes>;
    constexpr bool kColors = kChannels == Channels::WeightedColor || kChannels == Channels::Over;
    constexpr PixelBlock<Lanes, kTileStride> pixels;
    constexpr int kColumns = static_cast<int>(pixels.kColumns);
    constexpr int kRows = static_cast<int>(pixels.kRows);
    const glm::ivec2 least = glm::max(glm::ivec2(c.x, c.y), room.at);
    const glm::ivec2 most =
        glm::min(glm::ivec2(c.x + c.columns, c.y + c.rows), room.at + room.size);
    const CellLanes<Lanes> cell(lanes, view, c);
    const RangeLanes<Lanes> range(lanes, c);
    [[maybe_unused]] const auto color = [&] {
        if constexpr (kColors)
            return ColorLanes<kByValue, Lanes>(lanes, view, c);
        else
            return 0;
    }();
    [[maybe_unused]] const LightLanes<Lanes> light(lanes, view, c);
    float scale = view.weight;
    if constexpr (kColors) scale *= color.weight;
    const V weight = hn::Set(lanes, scale), zero = hn::Zero(lanes);
    const V perRange = hn::Set(lanes, scale / view.weight * c.perRange);
    const float* const factors = room.factor.data();
    const V far = hn::Set(lanes, 3e38f);
    const bool hides = room.nearestOpaque < 1;
    const V depthA = hn::Set(lanes, static_cast<float>(view.depthA));
    const V depthB = hn::Set(lanes, static_cast<float>(view.depthB));
    const V stepsX = pixels.columns(lanes), stepsY = pixels.rows(lanes);
    RayParts<Lanes> r;
    for (int x = least.x; x < most.x; x += kColumns) {
        const V ox = hn::Add(hn::Set(lanes, c.ox + static_cast<float>(x - c.x)), stepsX);
        for (int y = least.y; y < most.y; y += kRows) {
            const auto at = static_cast<std::size_t>((y - room.at.y) * kTileStride + x - room.at.x);
            const V oy = hn::Add(hn::Set(lanes, c.oy + static_cast<float>(y - c.y)), stepsY);
            V to = far;
            if (hides) {
                const V opaque = pixels.load(lanes, room.opaque.data() + at);
                to = hn::Sub(hn::Div(depthA, hn::Sub(opaque, depthB)), cell.base);
            }
            cell.meet(ox, oy, to, r);
            const auto inside = hn::Gt(r.length, zero);
            if (hn::AllFalse(lanes, inside)) continue;
            V t = hn::Mul(weight, r.length);
            V front = zero, back = zero;  // values that are seen
            if constexpr (kEnds > 0 || kByValue || kLit) cell.lookHalfWay(r);
            if constexpr (kEnds > 0 || kByValue) {
                V values[kPieces + 1], width = zero;
                cell.follow(r, values);
                V mean = r.value, low = hn::Min(values[0], values[kPieces]),
                  high = hn::Max(values[0], values[kPieces]);
                if constexpr (kEnds > 0) {
                    V perWidth, crossing;
                    cell.acrossPixel(r, width, perWidth);
                    // As if along the view axis: the ray's own length is a factor later.
                    if (c.perRange > 0)
                        crossing =
                            hn::Mul(perRange, reciprocal(lanes, pixels.load(lanes, factors + at)));
                    t = range.template sum<kEnds, kByValue>(values, width, perWidth, t,
                                                            c.perRange > 0 ? &crossing : nullptr,
                                                            mean, low, high);
                }
                if constexpr (kByValue) {
                    const V half = hn::Min(hn::Sub(mean, low), hn::Sub(high, mean));
                    const V along = hn::Sub(values[kPieces], values[0]);
                    const V toBack = hn::CopySign(hn::Max(half, zero), along);
                    front = hn::Sub(mean, toBack);
                    back = hn::Add(mean, toBack);
                    if constexpr (kChannels == Channels::Over)
                        back = seenTo(lanes, front, back,
                                      hn::Mul(t, pixels.load(lanes, factors + at)), along, width);
                }
            }
            t = hn::IfThenElseZero(inside, t);
            addWeight<kChannels>(pixels, lanes, t, room, at, [&](V* colors) HWY_ATTR {
                if constexpr (kColors) color.between(front, back, colors);
                if constexpr (kLit) {
                    V diffuse, specular;
                    const V change = cell.dot(r.gradient, r.along);
                    light.shade(r, change, pixels.load(lanes, factors + at), diffuse, specular);
                    for (int k = 0; k < 3; ++k)
                        colors[k] = hn::MulAdd(colors[k], diffuse, specular);
                }
            });
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
