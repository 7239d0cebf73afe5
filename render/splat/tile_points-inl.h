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
#include "render/splat/lanes-inl.h"
#include "render/splat/tile_view.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE I joinedInts(const D* halves) {
    return hn::Combine(Ints(), hn::DemoteTo(HalfInts(), halves[1]),
                       hn::DemoteTo(HalfInts(), halves[0]));
}

// Points of the grid, one a lane.
struct Points {
    I at[3];
    F depth, perDepth, window[2];  // window positions count from the tile
    F centre[2];                   // from the view axis
    F windowDepth;
};

HWY_INLINE Points see(const TileView& view, const std::uint32_t* index, glm::ivec2 tileAt) {
    D at[3][2], depth[2], perDepth[2], window[2][2], centre[2][2], windowDepth[2];
    for (int half = 0; half < 2; ++half) {
        D ijk[3], along[3], seen[3];
        alongAxes(view.size, index + static_cast<std::size_t>(half) * hn::Lanes(Doubles()), ijk);
        positionsOf(view.position, ijk, along);
        for (int a = 0; a < 3; ++a) at[a][half] = ijk[a];
        for (std::size_t k = 0; k < 3; ++k)
            seen[k] = hn::MulAdd(along[0], d(view.viewFromAxes[0][k]),
                                 hn::MulAdd(along[1], d(view.viewFromAxes[1][k]),
                                            hn::MulAdd(along[2], d(view.viewFromAxes[2][k]),
                                                       d(view.viewFromAxes[3][k]))));
        depth[half] = hn::Neg(seen[2]);
        perDepth[half] = hn::Div(d(1), depth[half]);
        windowDepth[half] = hn::MulAdd(perDepth[half], d(view.depthA), d(view.depthB));
        for (std::size_t k = 0; k < 2; ++k) {
            centre[k][half] = hn::Mul(hn::Mul(seen[k], d(view.focal[k])), perDepth[half]);
            window[k][half] =
                hn::Add(centre[k][half], d(view.centre[k] - tileAt[static_cast<int>(k)]));
        }
    }
    return {{joinedInts(at[0]), joinedInts(at[1]), joinedInts(at[2])},
            joined(depth),
            joined(perDepth),
            {joined(window[0]), joined(window[1])},
            {joined(centre[0]), joined(centre[1])},
            joined(windowDepth)};
}

// Where points are seen, in float, which is near enough to find tiles.
HWY_INLINE Points seeRoughly(const TileView& view, const std::uint32_t* index) {
    const Floats floats;
    D at[3][2];
    for (int half = 0; half < 2; ++half) {
        D ijk[3];
        alongAxes(view.size, index + static_cast<std::size_t>(half) * hn::Lanes(Doubles()), ijk);
        for (int a = 0; a < 3; ++a) at[a][half] = ijk[a];
    }
    Points p;
    F along[3], seen[3];
    for (std::size_t a = 0; a < 3; ++a) {
        p.at[a] = joinedInts(at[a]);
        along[a] = hn::GatherIndex(floats, view.roughPosition[a].data(), p.at[a]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const auto column = [&](std::size_t c)
                                HWY_ATTR { return f(static_cast<float>(view.viewFromAxes[c][k])); };
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

HWY_INLINE F largestSemiAxis(const TileView& view, const Points& p) {
    const float largest = std::max({view.semiAxes[0], view.semiAxes[1], view.semiAxes[2]});
    if (view.even) return hn::Mul(growth(view, p), f(largest));
    F sides[3];
    sidesOf(view, p, sides);
    const F longest = hn::Max(sides[0], hn::Max(sides[1], sides[2]));
    return hn::Max(hn::Mul(longest, f(view.kernel)), hn::Mul(p.depth, f(view.least)));
}

// No less than sphereExtent() in pixels, and little more where splats are small beside their
// distance; without bounds where the outline reaches behind the eye. What lies beside a footprint
// takes nothing, so that more than its outline costs time alone.
HWY_INLINE F extent(const TileView& view, const Points& p) {
    const F one = f(1);
    const F tanX = hn::Mul(p.centre[0], f(static_cast<float>(1 / view.focal[0]))),
            tanY = hn::Mul(p.centre[1], f(static_cast<float>(1 / view.focal[1])));
    const F tan2 = hn::MulAdd(tanX, tanX, hn::Mul(tanY, tanY));
    const F tan = hn::Mul(tan2, hn::ApproximateReciprocalSqrt(hn::Max(tan2, f(1e-20f))));
    const F cos = hn::ApproximateReciprocalSqrt(hn::Add(one, tan2));
    const F radius = hn::Mul(hn::Mul(largestSemiAxis(view, p), f(view.reach)), p.perDepth);
    const F sin = hn::Mul(radius, cos);
    // cos(theta + phi), or less: cos(phi) >= 1 - sin(phi)^2.
    const F cosSum = hn::NegMulAdd(tan, sin, hn::NegMulAdd(sin, sin, one));
    const F wide = hn::Mul(radius, hn::ApproximateReciprocal(hn::Mul(cos, hn::Mul(cos, cosSum))));
    constexpr float kGuesses = 1.01f;  // at how much approximate reciprocals may be wrong
    const auto most = static_cast<float>(std::max(view.focal[0], view.focal[1]));
    return hn::IfThenElse(hn::Gt(cosSum, f(1e-3f)), hn::Mul(hn::Mul(wide, cos), f(most * kGuesses)),
                          f(1e9f));
}

// Pixels [first, last) of a row or column whose centres an extent about `window` reaches.
HWY_INLINE void reached(F window, F extent, float limit, F* first, F* last) {
    const F zero = hn::Zero(Floats()), half = f(0.5f);
    *first = hn::Min(hn::Max(hn::Ceil(hn::Sub(hn::Sub(window, extent), half)), zero), f(limit));
    *last = hn::Min(hn::Max(hn::Ceil(hn::Sub(hn::Add(window, extent), half)), zero), f(limit));
}
HWY_INLINE void square(F window, int side, float limit, F* first, F* last) {
    const F zero = hn::Zero(Floats());
    const auto length = static_cast<float>(side);
    const F from = hn::Floor(hn::Sub(window, f(0.5f * (length - 1))));
    *first = hn::Min(hn::Max(from, zero), f(limit));
    *last = hn::Min(hn::Max(hn::Add(from, f(length)), zero), f(limit));
}
HWY_INLINE void boxOf(const TileView& view, const Points& p, glm::ivec2 limit, F* first, F* last) {
    const F reach = view.pointSide > 0 ? hn::Zero(Floats()) : extent(view, p);
    for (int k = 0; k < 2; ++k) {
        const auto most = static_cast<float>(limit[k]);
        if (view.pointSide > 0)
            square(p.window[k], view.pointSide, most, first + k, last + k);
        else
            reached(p.window[k], reach, most, first + k, last + k);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
