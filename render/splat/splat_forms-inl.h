// What splatAt() of render/model/footprint.h makes of a splat, one a lane. Compiled once for each
// of Highway's targets, so not guarded as other headers are.
#if defined(RENDER_SPLAT_FORMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SPLAT_FORMS_INL_H_
#undef RENDER_SPLAT_FORMS_INL_H_
#else
#define RENDER_SPLAT_FORMS_INL_H_
#endif

#include "render/splat/lanes-inl.h"
#include "render/splat/tile_view.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kAllPixels = 4e9f;  // of offsets and window positions: nothing beyond is seen

// Where the eye sees points that lie there in coordinates that `m`'s columns take into the view,
// half as many.
struct SeenHalf {
    D depth, perDepth, windowDepth;
    D centre[2];  // in pixels from the view axis
};
HWY_INLINE SeenHalf see(const TileView& view, const TileView::Columns& m, const D* along) {
    D seen[3];
    for (std::size_t k = 0; k < 3; ++k)
        seen[k] = hn::MulAdd(
            along[0], d(m[0][k]),
            hn::MulAdd(along[1], d(m[1][k]), hn::MulAdd(along[2], d(m[2][k]), d(m[3][k]))));
    SeenHalf half;
    half.depth = hn::Neg(seen[2]);
    half.perDepth = hn::Div(d(1), half.depth);
    half.windowDepth = hn::MulAdd(half.perDepth, d(view.depthA), d(view.depthB));
    for (std::size_t k = 0; k < 2; ++k)
        half.centre[k] = hn::Mul(hn::Mul(seen[k], d(view.focal[k])), half.perDepth);
    return half;
}

// nearFade().
HWY_INLINE F faded(const TileView& view, F depth) {
    const F t = hn::Min(hn::Max(hn::Sub(hn::Mul(depth, f(1 / view.near)), f(1)), f(0)), f(1));
    return hn::Mul(hn::Mul(t, t), hn::NegMulAdd(f(2), t, f(3)));
}

// The ray of a pixel's offset from the view axis, in axis coordinates.
HWY_INLINE F rayOf(const TileView& view, const F* centre, std::size_t axis) {
    return hn::MulAdd(centre[0], f(view.perPixelX[axis]),
                      hn::MulAdd(centre[1], f(view.perPixelY[axis]), f(view.axis[axis])));
}

// n of the centre's ray and of what a pixel adds to it, in kernel space, but for depth^2 / |c|^2.
HWY_INLINE void crossForm(const F* c, const F* x, const F* y, F scale, F* n) {
    F across[3], other[3];
    cross(c, x, across);
    cross(c, y, other);
    n[0] = hn::Mul(scale, dot(across, across));
    n[1] = hn::Mul(scale, hn::Mul(f(2), dot(across, other)));
    n[2] = hn::Mul(scale, dot(other, other));
}

// All of them, of splats that are not even.
struct Forms {
    F n[3], d[3], l[2];
    F perC2;  // 1 / |c|^2
};
HWY_INLINE Forms formsOf(const F* c, const F* x, const F* y, F depth) {
    Forms out;
    out.perC2 = hn::Div(f(1), dot(c, c));
    const F two = hn::Mul(f(2), out.perC2);
    crossForm(c, x, y, hn::Mul(hn::Mul(depth, depth), out.perC2), out.n);
    out.d[0] = hn::Mul(out.perC2, dot(x, x));
    out.d[1] = hn::Mul(two, dot(x, y));
    out.d[2] = hn::Mul(out.perC2, dot(y, y));
    out.l[0] = hn::Mul(two, dot(c, x));
    out.l[1] = hn::Mul(two, dot(c, y));
    return out;
}

// Between which offsets from the centre, in pixels, the outlines of ellipsoids lie whose surfaces
// are M u for |u| = 1, M's rows along the view's axes. A plane through the eye that holds all
// x / -z = t + s, where the centre has t, touches it where |x' + (t + s) z'|^2 = s^2 depth^2, of
// the rows x' and z': a square equation in s, of which nothing cancels however thin M is. A little
// more, for rounding; far more than a picture where an ellipsoid reaches behind the eye.
HWY_INLINE void outlineOf(const TileView& view, F depth, const F* centre, const F (*row)[3], F* lo,
                          F* hi) {
    const F* const z = row[2];
    const F depth2 = hn::Mul(depth, depth), rest = hn::Sub(depth2, dot(z, z));
    const auto isBefore = hn::Gt(rest, hn::Mul(f(1e-5f), depth2));
    const F perRest = hn::Div(f(1), rest);
    for (std::size_t k = 0; k < 2; ++k) {
        const F tan = hn::Mul(centre[k], f(static_cast<float>(1 / view.focal[k])));
        F u[3];
        for (std::size_t a = 0; a < 3; ++a) u[a] = hn::MulAdd(tan, z[a], row[k][a]);
        const F lean = dot(u, z);
        const F root = hn::Sqrt(hn::MulAdd(lean, lean, hn::Mul(rest, dot(u, u))));
        const F scale = hn::Mul(perRest, f(static_cast<float>(view.focal[k])));
        const F middle = hn::Mul(lean, scale);
        const F half = hn::MulAdd(hn::Mul(root, scale), f(1.001f), f(0.01f));
        lo[k] = hn::IfThenElse(isBefore, hn::Sub(middle, half), f(-kAllPixels));
        hi[k] = hn::IfThenElse(isBefore, hn::Add(middle, half), f(kAllPixels));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
