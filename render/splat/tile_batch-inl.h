// Splats made ready for the pixels of one tile, one a lane. Compiled once for each of Highway's
// targets, so not guarded as other headers are.
#if defined(RENDER_TILE_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_TILE_BATCH_INL_H_
#undef RENDER_TILE_BATCH_INL_H_
#else
#define RENDER_TILE_BATCH_INL_H_
#endif

#include <algorithm>
#include <cmath>

#include "render/splat/tile_points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// As many splats as there are lanes, each ready for the pixels of one tile.
struct Batch {
    // Offsets o of the first pixel from the centre; q = n(o) / d(o) as in footprint.h, or, even,
    // n(o) times what the pixel's ray gives.
    alignas(64) float ox[kLanes], oy[kLanes], nxx[kLanes], nxy[kLanes], nyy[kLanes];
    alignas(64) float dxx[kLanes], dxy[kLanes], dyy[kLanes], lx[kLanes], ly[kLanes];
    alignas(64) float weight[kLanes], depth[kLanes], red[kLanes], green[kLanes], blue[kLanes];
    alignas(64) std::int32_t x[kLanes], y[kLanes], columns[kLanes], rows[kLanes];
};

HWY_INLINE F faded(const TileView& view, const Points& p) {
    const F zero = hn::Zero(Floats()), one = f(1);
    const F t = hn::Min(hn::Max(hn::Sub(hn::Mul(p.depth, f(1 / view.near)), one), zero), one);
    return hn::Mul(hn::Mul(t, t), hn::NegMulAdd(f(2), t, f(3)));
}

HWY_INLINE F volume(const TileView& view, const Points& p) {
    F sides[3];
    sidesOf(view, p, sides);
    return hn::Mul(hn::Mul(sides[0], sides[1]), sides[2]);
}

template <bool kEven>
HWY_INLINE F setUpFootprint(const TileView& view, const Points& p, Batch& out) {
    const Floats floats;
    F c[3], x[3], y[3], e[3], g[3];
    F perSemiAxis[3], weight = f(view.weight), grown = f(1);
    if constexpr (kEven) {
        grown = growth(view, p);
        for (std::size_t a = 0; a < 3; ++a) perSemiAxis[a] = f(1 / view.semiAxes[a]);
    } else {
        F sides[3];
        sidesOf(view, p, sides);
        for (std::size_t a = 0; a < 3; ++a) {
            weight = hn::Mul(weight, sides[a]);
            perSemiAxis[a] = hn::Div(
                f(1), hn::Max(hn::Mul(sides[a], f(view.kernel)), hn::Mul(p.depth, f(view.least))));
            weight = hn::Mul(weight, perSemiAxis[a]);
        }
    }
    for (std::size_t a = 0; a < 3; ++a) {
        const F ray = hn::MulAdd(p.centre[0], f(view.perPixelX[a]),
                                 hn::MulAdd(p.centre[1], f(view.perPixelY[a]), f(view.axis[a])));
        c[a] = hn::Mul(ray, perSemiAxis[a]);
        x[a] = hn::Mul(f(view.perPixelX[a]), perSemiAxis[a]);
        y[a] = hn::Mul(f(view.perPixelY[a]), perSemiAxis[a]);
    }
    cross(c, x, e);
    cross(c, y, g);
    const F two = f(2);
    F scale = hn::Mul(p.depth, p.depth);
    if constexpr (kEven) {
        const F perGrown2 = hn::Div(f(1), hn::Mul(grown, grown));
        scale = hn::Mul(scale, perGrown2);
        weight = hn::Mul(weight, perGrown2);
    } else {
        const F perC2 = hn::Div(f(1), dot(c, c));
        scale = hn::Mul(scale, perC2);
        weight = hn::Mul(weight, hn::Sqrt(perC2));
        hn::Store(hn::Mul(perC2, dot(x, x)), floats, out.dxx);
        hn::Store(hn::Mul(perC2, hn::Mul(two, dot(x, y))), floats, out.dxy);
        hn::Store(hn::Mul(perC2, dot(y, y)), floats, out.dyy);
        hn::Store(hn::Mul(perC2, hn::Mul(two, dot(c, x))), floats, out.lx);
        hn::Store(hn::Mul(perC2, hn::Mul(two, dot(c, y))), floats, out.ly);
    }
    hn::Store(hn::Mul(scale, dot(e, e)), floats, out.nxx);
    hn::Store(hn::Mul(scale, hn::Mul(two, dot(e, g))), floats, out.nxy);
    hn::Store(hn::Mul(scale, dot(g, g)), floats, out.nyy);
    return weight;
}

HWY_INLINE void setUpBox(const TileView& view, const Points& p, glm::ivec2 at, glm::ivec2 limit,
                         Batch& out) {
    const Floats floats;
    const Ints ints;
    F first[2], last[2];
    boxOf(view, p, view.pointSide > 0 ? view.box.size : limit, first, last);
    if (view.pointSide > 0)  // points' windows are the box's, so that all tiles round them alike
        for (int k = 0; k < 2; ++k) {
            const F zero = hn::Zero(floats), most = f(static_cast<float>(limit[k]));
            const F corner = f(static_cast<float>(at[k]));
            first[k] = hn::Min(hn::Max(hn::Sub(first[k], corner), zero), most);
            last[k] = hn::Min(hn::Max(hn::Sub(last[k], corner), zero), most);
        }
    // The centre in double decides what is drawn.
    const auto drawn = hn::And(hn::Gt(p.depth, f(view.near)), hn::Le(p.windowDepth, f(1)));
    last[0] = hn::IfThenElse(drawn, last[0], first[0]);
    hn::Store(hn::ConvertTo(ints, first[0]), ints, out.x);
    hn::Store(hn::ConvertTo(ints, first[1]), ints, out.y);
    hn::Store(hn::ConvertTo(ints, hn::Sub(last[0], first[0])), ints, out.columns);
    hn::Store(hn::ConvertTo(ints, hn::Sub(last[1], first[1])), ints, out.rows);
    hn::Store(hn::Sub(hn::Add(first[0], f(0.5f)), p.window[0]), floats, out.ox);
    hn::Store(hn::Sub(hn::Add(first[1], f(0.5f)), p.window[1]), floats, out.oy);
    hn::Store(p.windowDepth, floats, out.depth);
}

// Between a tint and the next; what it weighs.
HWY_INLINE F setUpTints(const TileView& view, const float* places, Batch& out) {
    const Floats floats;
    const F at = hn::LoadU(floats, places);
    const F last = f(static_cast<float>(view.tints.size() - 2));
    const F below = hn::Min(hn::Floor(at), last);
    const F share = hn::Sub(at, below);
    const auto first = hn::ShiftLeft<2>(hn::ConvertTo(Ints(), below));
    const float* table = view.tints[0].data();
    float* const to[3] = {out.red, out.green, out.blue};
    for (int c = 0; c < 3; ++c) {
        const F low = hn::GatherIndex(floats, table + c, first);
        const F high = hn::GatherIndex(floats, table + c + 4, first);
        hn::Store(hn::MulAdd(share, hn::Sub(high, low), low), floats, to[c]);
    }
    return hn::GatherIndex(floats, table + 3, first);
}

// Of splats that were worked out before.
HWY_INLINE void takeSeen(const TileView& view, const std::uint32_t* index, glm::ivec2 at,
                         glm::ivec2 size, Batch& out) {
    const Floats floats;
    const Ints ints;
    constexpr std::size_t kStride = sizeof(SeenSplat) / sizeof(float);
    const I first = hn::Mul(hn::LoadU(ints, reinterpret_cast<const std::int32_t*>(index)),
                            hn::Set(ints, static_cast<std::int32_t>(kStride)));
    const SeenSplat& base = view.meshSplats.front();
    const auto of = [&](const float& field)
                        HWY_ATTR { return hn::GatherIndex(floats, &field, first); };
    float* const offset[2] = {out.ox, out.oy};
    std::int32_t* const begin[2] = {out.x, out.y};
    std::int32_t* const count[2] = {out.columns, out.rows};
    for (std::size_t k = 0; k < 2; ++k) {
        const int c = static_cast<int>(k);
        const F zero = hn::Zero(floats), most = f(static_cast<float>(size[c]));
        const F whole = hn::ConvertTo(
            floats, hn::Sub(hn::GatherIndex(ints, &base.pixel[k], first), hn::Set(ints, at[c])));
        const F within = hn::Sub(of(base.within[k]), f(0.5f));
        const auto reached = [&](F way) HWY_ATTR {
            return hn::Min(hn::Max(hn::Add(hn::Ceil(hn::Add(within, way)), whole), zero), most);
        };
        const F from = reached(of(base.lo[k])), to = reached(of(base.hi[k]));
        hn::Store(hn::ConvertTo(ints, from), ints, begin[k]);
        hn::Store(hn::ConvertTo(ints, hn::Sub(to, from)), ints, count[k]);
        hn::Store(hn::Sub(hn::Sub(from, whole), within), floats, offset[k]);
    }
    float* const form[] = {out.nxx, out.nxy, out.nyy, out.dxx, out.dxy, out.dyy, out.lx, out.ly};
    const float* const field[] = {&base.n[0], &base.n[1], &base.n[2], &base.d[0],
                                  &base.d[1], &base.d[2], &base.l[0], &base.l[1]};
    for (std::size_t i = 0; i < std::size(form); ++i) hn::Store(of(*field[i]), floats, form[i]);
    hn::Store(of(base.weight), floats, out.weight);
    hn::Store(of(base.depth), floats, out.depth);
}

HWY_INLINE void setUp(const TileView& view, const std::uint32_t* index, const float* tints,
                      glm::ivec2 at, glm::ivec2 size, Batch& out) {
    if (!view.meshSplats.empty()) {
        takeSeen(view, index, at, size, out);
        const F weight = hn::Load(Floats(), out.weight);
        if (tints != nullptr)
            hn::Store(hn::Mul(weight, setUpTints(view, tints, out)), Floats(), out.weight);
        return;
    }
    const Points p = see(view, index, view.pointSide > 0 ? glm::ivec2(0) : at);
    setUpBox(view, p, at, size, out);
    F weight;
    if (view.pointSide > 0)
        weight = hn::Mul(hn::Mul(f(view.weight), volume(view, p)), hn::Mul(p.perDepth, p.perDepth));
    else
        weight =
            view.even ? setUpFootprint<true>(view, p, out) : setUpFootprint<false>(view, p, out);
    weight = hn::Mul(weight, faded(view, p));
    if (tints != nullptr) weight = hn::Mul(weight, setUpTints(view, tints, out));
    hn::Store(weight, Floats(), out.weight);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
