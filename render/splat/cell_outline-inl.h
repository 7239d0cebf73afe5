// Where in a picture upright cells are seen, a vector of them at once: between which pixels their
// corners lie. Compiled once for each of Highway's targets, so not guarded as other headers are.
#if defined(RENDER_CELL_OUTLINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_CELL_OUTLINE_INL_H_
#undef RENDER_CELL_OUTLINE_INL_H_
#else
#define RENDER_CELL_OUTLINE_INL_H_
#endif

#include "render/splat/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// To the right and up, in units of the focal length: of cells that are all in front of the near
// plane from their middles, of others from the view axis. And more than arithmetic loses, in
// pixels.
struct CellOutline {
    F least[2], most[2], more[2];

    // Middles as the view sees them, half of each edge, and which cells are all in front.
    HWY_INLINE CellOutline(const CellView& view, const F* middle, const F (&half)[3][3],
                           hn::Mask<Floats> isWhole) {
        F centre[2], corners[8][3];
        for (int k = 0; k < 2; ++k) {
            centre[k] = hn::Neg(hn::Div(middle[k], middle[2]));
            least[k] = f(kFar);
            most[k] = f(-kFar);
            more[k] = f(0.01f);
        }
        for (unsigned c = 0; c < 8; ++c) {
            F(&v)[3] = corners[c];
            for (int k = 0; k < 3; ++k) {
                v[k] = middle[k];
                for (unsigned a = 0; a < 3; ++a)
                    v[k] = c >> a & 1 ? hn::Add(v[k], half[a][k]) : hn::Sub(v[k], half[a][k]);
            }
            const F per = hn::Neg(reciprocal(Floats(), v[2]));
            for (int k = 0; k < 2; ++k) {
                const F offset = hn::MulSub(v[k], per, centre[k]);
                least[k] = hn::Min(least[k], offset);
                most[k] = hn::Max(most[k], offset);
            }
        }
        if (!hn::AllTrue(Floats(), isWhole)) takeBeside(view, corners, isWhole);
    }

 private:
    static constexpr float kFar = 1e9f;

    // As SeenBounds, of those that the eye is beside or within.
    HWY_INLINE void takeBeside(const CellView& view, const F (&corners)[8][3],
                               hn::Mask<Floats> isWhole) {
        constexpr float kOfFloats = 1e-5f;
        const F near = f(view.near);
        F lo[2] = {f(kFar), f(kFar)}, hi[2] = {f(-kFar), f(-kFar)};
        const auto take = [&](const F* v, F depth, hn::Mask<Floats> is) HWY_ATTR {
            for (int k = 0; k < 2; ++k) {
                const F offset = hn::Div(v[k], depth);
                lo[k] = hn::IfThenElse(is, hn::Min(lo[k], offset), lo[k]);
                hi[k] = hn::IfThenElse(is, hn::Max(hi[k], offset), hi[k]);
            }
        };
        for (unsigned c = 0; c < 8; ++c) {
            const F depth = hn::Neg(corners[c][2]);
            const auto isFront = hn::Gt(depth, near);
            take(corners[c], depth, isFront);
            for (unsigned a = 0; a < 3; ++a) {
                const unsigned other = c | 1u << a;
                if (other == c) continue;
                const auto passes = hn::Xor(isFront, hn::Gt(hn::Neg(corners[other][2]), near));
                const F share = hn::Div(hn::Add(near, corners[c][2]),
                                        hn::Sub(corners[c][2], corners[other][2]));
                F v[2];
                for (int k = 0; k < 2; ++k)
                    v[k] =
                        hn::MulAdd(share, hn::Sub(corners[other][k], corners[c][k]), corners[c][k]);
                take(v, near, passes);
            }
        }
        for (int k = 0; k < 2; ++k) {
            const F focal = f(static_cast<float>(view.focal[static_cast<std::size_t>(k)]));
            const F far = hn::Mul(focal, hn::Max(hn::Abs(lo[k]), hn::Abs(hi[k])));
            least[k] = hn::IfThenElse(isWhole, least[k], lo[k]);
            most[k] = hn::IfThenElse(isWhole, most[k], hi[k]);
            more[k] = hn::IfThenElse(isWhole, more[k], hn::MulAdd(f(kOfFloats), far, more[k]));
        }
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
