// Points of the grid, one a lane: where a view sees them, and which pixels their splats may touch.
// Compiled once for each of Highway's targets, so not guarded as other headers are.
#if defined(RENDER_TILE_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_TILE_POINTS_INL_H_
#undef RENDER_TILE_POINTS_INL_H_
#else
#define RENDER_TILE_POINTS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "render/points/grid_indices-inl.h"
#include "render/splat/splat_forms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Points of the grid, one a lane.
struct Points {
    I at[3];
    F depth, perDepth, window[2];  // window positions count from the tile
    F centre[2];                   // from the view axis
    F windowDepth;
};

// Of words that stand as findTiles() leaves them.
HWY_INLINE void indicesOf(const TileView& view, const std::uint32_t* words, I* at) {
    if (!view.packs) {
        D half[2][3];
        for (std::size_t h = 0; h < 2; ++h)
            alongAxes(view.size, words + h * hn::Lanes(Doubles()), half[h]);
        for (std::size_t a = 0; a < 3; ++a) at[a] = joinedInts(half[0][a], half[1][a]);
        return;
    }
    const hn::Rebind<std::uint32_t, Floats> whole;
    const Ints ints;
    const auto word = hn::LoadU(whole, words);
    const auto low = [&](auto x, int bits)
                         HWY_ATTR { return hn::And(x, hn::Set(whole, (1u << bits) - 1)); };
    at[0] = hn::BitCast(ints, low(word, view.yAt));
    at[1] = hn::BitCast(ints, low(hn::ShiftRightSame(word, view.yAt), view.zAt - view.yAt));
    at[2] = hn::BitCast(ints, hn::ShiftRightSame(word, view.zAt));
}
HWY_INLINE void pack(const TileView& view, const I* at, std::uint32_t* words) {
    const auto y = hn::ShiftLeftSame(at[1], view.yAt), z = hn::ShiftLeftSame(at[2], view.zAt);
    hn::StoreU(hn::Or(at[0], hn::Or(y, z)), Ints(), reinterpret_cast<std::int32_t*>(words));
}

HWY_INLINE Points see(const TileView& view, const std::uint32_t* words, glm::ivec2 tileAt) {
    const HalfInts ints;
    I at[3];
    D window[2][2];
    SeenHalf half[2];
    indicesOf(view, words, at);
    for (std::size_t h = 0; h < 2; ++h) {
        D index[3], along[3];
        for (std::size_t a = 0; a < 3; ++a)
            index[a] = hn::PromoteTo(Doubles(),
                                     h ? hn::UpperHalf(ints, at[a]) : hn::LowerHalf(ints, at[a]));
        if (view.evenlySpaced) {
            half[h] = see(view, view.viewFromIndices, index);
        } else {
            positionsOf(view.position, index, along);
            half[h] = see(view, view.viewFromAxes, along);
        }
        for (std::size_t k = 0; k < 2; ++k)
            window[h][k] =
                hn::Add(half[h].centre[k], d(view.centre[k] - tileAt[static_cast<int>(k)]));
    }
    const auto& [low, high] = half;
    return {{at[0], at[1], at[2]},
            joined(low.depth, high.depth),
            joined(low.perDepth, high.perDepth),
            {joined(window[0][0], window[1][0]), joined(window[0][1], window[1][1])},
            {joined(low.centre[0], high.centre[0]), joined(low.centre[1], high.centre[1])},
            joined(low.windowDepth, high.windowDepth)};
}

// Where points are seen, in float, which is near enough to find tiles.
HWY_INLINE Points seeRoughly(const TileView& view, const std::uint32_t* index) {
    const Floats floats;
    D at[2][3];
    for (std::size_t half = 0; half < 2; ++half)
        alongAxes(view.size, index + half * hn::Lanes(Doubles()), at[half]);
    Points p;
    F along[3], seen[3];
    for (std::size_t a = 0; a < 3; ++a) {
        p.at[a] = joinedInts(at[0][a], at[1][a]);
        along[a] = view.evenlySpaced
                       ? hn::ConvertTo(floats, p.at[a])
                       : hn::GatherIndex(floats, view.roughPosition[a].data(), p.at[a]);
    }
    const TileView::Columns& m = view.evenlySpaced ? view.viewFromIndices : view.viewFromAxes;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto column = [&](std::size_t c) HWY_ATTR { return f(static_cast<float>(m[c][k])); };
        seen[k] =
            hn::MulAdd(along[0], column(0),
                       hn::MulAdd(along[1], column(1), hn::MulAdd(along[2], column(2), column(3))));
    }
    p.depth = hn::Neg(seen[2]);
    p.perDepth = hn::Div(f(1), p.depth);
    p.windowDepth = hn::MulAdd(p.perDepth, f(static_cast<float>(view.depthA)),
                               f(static_cast<float>(view.depthB)));
    for (std::size_t k = 0; k < 2; ++k) {
        p.centre[k] = hn::Mul(hn::Mul(seen[k], f(static_cast<float>(view.focal[k]))), p.perDepth);
        p.window[k] = hn::Add(p.centre[k], f(static_cast<float>(view.centre[k])));
    }
    return p;
}

HWY_INLINE void sidesOf(const TileView& view, const Points& p, F* sides) {
    for (std::size_t a = 0; a < 3; ++a)
        sides[a] = hn::GatherIndex(Floats(), view.width[a].data(), p.at[a]);
}

// What even splats are larger than `semiAxes`: more than once only where those are cubes.
HWY_INLINE F growth(const TileView& view, const Points& p) {
    return hn::Max(hn::Mul(p.depth, f(view.least / view.semiAxes[0])), f(1));
}

HWY_INLINE void semiAxesOf(const TileView& view, const Points& p, F* semiAxes) {
    F sides[3];
    sidesOf(view, p, sides);
    for (std::size_t a = 0; a < 3; ++a)
        semiAxes[a] = hn::Max(hn::Mul(sides[a], f(view.kernel)), hn::Mul(p.depth, f(view.least)));
}

// No less than sphereExtent() in pixels, of even splats that are spheres, and little more where
// they are small beside their distance; without bounds where the outline reaches behind the eye.
// What lies beside a footprint takes nothing, so that more than its outline costs time alone.
HWY_INLINE F sphereExtent(const TileView& view, const Points& p) {
    const F one = f(1);
    const F tanX = hn::Mul(p.centre[0], f(static_cast<float>(1 / view.focal[0]))),
            tanY = hn::Mul(p.centre[1], f(static_cast<float>(1 / view.focal[1])));
    const F tan2 = hn::MulAdd(tanX, tanX, hn::Mul(tanY, tanY));
    const F tan = hn::Mul(tan2, hn::ApproximateReciprocalSqrt(hn::Max(tan2, f(1e-20f))));
    const F cos = hn::ApproximateReciprocalSqrt(hn::Add(one, tan2));
    const F semiAxis = hn::Mul(growth(view, p), f(view.semiAxes[0]));
    const F radius = hn::Mul(hn::Mul(semiAxis, f(view.reach)), p.perDepth);
    const F sin = hn::Mul(radius, cos);
    // cos(theta + phi), or less: cos(phi) >= 1 - sin(phi)^2.
    const F cosSum = hn::NegMulAdd(tan, sin, hn::NegMulAdd(sin, sin, one));
    const F wide = hn::Mul(radius, hn::ApproximateReciprocal(hn::Mul(cos, hn::Mul(cos, cosSum))));
    constexpr float kGuesses = 1.01f;  // at how much approximate reciprocals may be wrong
    const auto most = static_cast<float>(std::max(view.focal[0], view.focal[1]));
    return hn::IfThenElse(hn::Gt(cosSum, f(1e-3f)), hn::Mul(hn::Mul(wide, cos), f(most * kGuesses)),
                          f(kAllPixels));
}

// Between which offsets from their centres, in pixels, footprints lie.
HWY_INLINE void extentsOf(const TileView& view, const Points& p, F* lo, F* hi) {
    if (view.spheres) {
        hi[0] = hi[1] = sphereExtent(view, p);
        for (std::size_t k = 0; k < 2; ++k) lo[k] = hn::Neg(hi[k]);
        return;
    }
    F semiAxes[3], row[3][3];
    semiAxesOf(view, p, semiAxes);
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t a = 0; a < 3; ++a)
            row[k][a] = hn::Mul(semiAxes[a], f(static_cast<float>(view.viewFromAxes[a][k])));
    outlineOf(view, p.depth, p.centre, row, lo, hi);
}

// Pixels [first, last) of a row or column whose centres offsets from `window` reach.
HWY_INLINE void reached(F window, F lo, F hi, float limit, F* first, F* last) {
    const F zero = hn::Zero(Floats()), half = f(0.5f);
    *first = hn::Min(hn::Max(hn::Ceil(hn::Sub(hn::Add(window, lo), half)), zero), f(limit));
    *last = hn::Min(hn::Max(hn::Ceil(hn::Sub(hn::Add(window, hi), half)), zero), f(limit));
}
HWY_INLINE void square(F window, int side, float limit, F* first, F* last) {
    const F zero = hn::Zero(Floats());
    const auto length = static_cast<float>(side);
    const F from = hn::Floor(hn::Sub(window, f(0.5f * (length - 1))));
    *first = hn::Min(hn::Max(from, zero), f(limit));
    *last = hn::Min(hn::Max(hn::Add(from, f(length)), zero), f(limit));
}
HWY_INLINE void boxOf(const TileView& view, const Points& p, glm::ivec2 limit, F* first, F* last) {
    F lo[2], hi[2];
    if (view.pointSide == 0) extentsOf(view, p, lo, hi);
    for (int k = 0; k < 2; ++k) {
        const auto most = static_cast<float>(limit[k]);
        if (view.pointSide > 0)
            square(p.window[k], view.pointSide, most, first + k, last + k);
        else
            reached(p.window[k], lo[k], hi[k], most, first + k, last + k);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
