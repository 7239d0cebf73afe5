// What rays have in a cell, side by side in vectors: the way through it, the field along it, and
// light. Compiled once for each of Highway's targets, so not guarded as other headers are.
#if defined(RENDER_CELL_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_CELL_RAYS_INL_H_
#undef RENDER_CELL_RAYS_INL_H_
#else
#define RENDER_CELL_RAYS_INL_H_
#endif

#include "render/splat/cell_range-inl.h"
#include "render/splat/cell_slopes.h"
#include "render/splat/cell_view.h"

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

// Where a cell lies, the same in every lane.
template <class Lanes>
struct MeetLanes {
    using V = hn::Vec<Lanes>;
    Lanes lanes;
    V base, before, at[3], ray[3], x[3], y[3];
    bool grazes;
    MeetLanes(Lanes l, const CellView& view, const SeenCell& c)
        : lanes(l),
          base(hn::Set(l, c.base)),
          before(hn::Set(l, c.base - view.near)),
          grazes(c.grazes()) {
        for (std::size_t a = 0; a < 3; ++a) {
            at[a] = hn::Set(l, c.at[a]);
            ray[a] = hn::Set(l, c.ray[a]);
            const V perSize = hn::Set(l, c.perSize[a]);
            x[a] = hn::Mul(perSize, hn::Set(l, view.perPixelX[a]));
            y[a] = hn::Mul(perSize, hn::Set(l, view.perPixelY[a]));
        }
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
        // Of rays beside the cell what may be computed with: they weigh nothing, but a colour that
        // is no number would be one times that, too.
        const V zero = hn::Zero(lanes);
        r.length = hn::Max(hn::Add(front, back), zero);
        r.depth = hn::IfThenElseZero(hn::Gt(r.length, zero), hn::Mul(half, hn::Sub(back, front)));
    }
};

// The field in it.
template <class Lanes>
struct CellLanes {
    using V = hn::Vec<Lanes>;
    Lanes lanes;
    V base, right[3], up[3], f[8];  // steps as of a CellSplat
    float widest;
    CellLanes(Lanes l, const CellView& view, const SeenCell& c)
        : lanes(l), base(hn::Set(l, c.base)) {
        const auto inCell = [&](const std::array<float, 3>& v) {
            return glm::vec3(v[0] * c.perSize[0], v[1] * c.perSize[1], v[2] * c.perSize[2]);
        };
        glm::vec3 x = inCell(view.perPixelX), y = inCell(view.perPixelY);
        double flat = 0;
        if (c.mayBeFlat())
            flat = cell::alongCell(glm::vec3(c.ray[0], c.ray[1], c.ray[2]), c.base, x, y);
        widest = cell::widestRamp(c, c.crossesLeast(), c.crossesMost(), static_cast<float>(flat));
        for (std::size_t a = 0; a < 3; ++a) {
            right[a] = hn::Set(l, x[static_cast<int>(a)]);
            up[a] = hn::Set(l, y[static_cast<int>(a)]);
        }
        for (std::size_t k = 0; k < 8; ++k) f[k] = hn::Set(l, c.f[k]);
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
        const auto ends = [&](float way, V& fromFront, V& fromBack) HWY_ATTR {
            const V even = hn::MulAdd(hn::Set(lanes, way * way), second, r.value);
            const V odd =
                hn::Mul(hn::Set(lanes, way), hn::MulAdd(hn::Set(lanes, way * way), third, first));
            fromFront = hn::Sub(even, odd);
            fromBack = hn::Add(even, odd);
        };
        ends(1, values[0], values[3]);
        ends(1 / 3.0f, values[1], values[2]);
    }
    // The square of the width of the ramp that a pixel makes of an end of the range.
    HWY_INLINE V acrossPixel2(const RayParts<Lanes>& r) const {
        constexpr float kLeast = static_cast<float>(2 * kLeastChange);
        const V alongX = dot(r.gradient, right), alongY = dot(r.gradient, up);
        const V depth = hn::Add(base, r.depth);
        const V change2 =
            hn::Mul(hn::Mul(depth, depth), hn::MulAdd(alongX, alongX, hn::Mul(alongY, alongY)));
        return hn::Min(hn::Max(change2, hn::Set(lanes, kLeast * kLeast)),
                       hn::Set(lanes, widest * widest));
    }
    HWY_INLINE V dot(const V* a, const V* b) const {
        return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
    }
};

// From the middle of a ray's way, where the field has that value and changes so, to where, in the
// mean, light leaves what lies in the range, as if it were linear along the ray: of an optical
// depth x.
template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE V inRange(Lanes lanes, const SeenPiece& c, V value, V change, V length, V x) {
    constexpr float kBeyond = 2;  // more than f can be
    const V share = shareFromFront(lanes, x), reach = hn::Mul(hn::Set(lanes, 0.5f), length);
    if (!c.crossesLeast() && !c.crossesMost()) return hn::MulSub(share, length, reach);
    const V least = hn::Set(lanes, 1e-12f);
    const V per = reciprocal(lanes, hn::CopySign(hn::Max(hn::Abs(change), least), change));
    const auto at = [&](float bound) HWY_ATTR {
        const V way = hn::Mul(hn::Sub(hn::Set(lanes, bound), value), per);
        return hn::Min(hn::Max(way, hn::Neg(reach)), reach);
    };
    const V a = at(c.crossesLeast() ? c.least : -kBeyond),
            b = at(c.crossesMost() ? c.most : kBeyond);
    const V front = hn::Min(a, b), back = hn::Max(a, b);
    return hn::MulAdd(share, hn::Sub(back, front), front);
}

// Where light comes from, if there is some.
enum class Lit { No, FromEye, FromLamp };

// What light makes of a colour where the field has a gradient, told in units of which an axis has
// perAxis. At pixels whose rays are `factor` times as long as the view axis'.
template <class Lanes>
struct LightLanes {
    using V = hn::Vec<Lanes>;
    Lanes lanes;
    const CellView& view;
    std::array<float, 3> perAxis;
    V steep, perUnit;
    LightLanes(Lanes l, const CellView& of, float steepness, const std::array<float, 3>& units)
        : lanes(l),
          view(of),
          perAxis(units),
          steep(hn::Set(l, steepness)),
          perUnit(hn::Set(l, 1 / view.rayLength)) {}
    // Of a gradient, which is `change` along a ray that goes on so.
    template <Lit kLit>
    HWY_INLINE void shade(const V* g, V change, const V* way, V factor, V& diffuse,
                          V& specular) const {
        const V one = hn::Set(lanes, 1.0f), tiny = hn::Set(lanes, 1e-30f);
        const V per = reciprocalRoot(lanes, hn::Max(square(g), tiny));
        const V certainty = reciprocal(lanes, hn::MulAdd(steep, per, one));
        const V perLength = hn::Mul(perUnit, reciprocal(lanes, factor));
        const V facing = hn::Min(one, hn::Mul(hn::Mul(hn::Abs(change), per), perLength));
        if constexpr (kLit == Lit::FromEye) {
            lightOf(lanes, view.light, certainty, facing, facing, diffuse, specular);
        } else {
            V ofGradient = hn::Zero(lanes), ofRay = ofGradient;
            for (int a = 0; a < 3; ++a) {
                const float unit = perAxis[static_cast<std::size_t>(a)];
                ofGradient =
                    hn::MulAdd(hn::Set(lanes, view.lamp->ofGradient[a] * unit), g[a], ofGradient);
                ofRay = hn::MulAdd(hn::Set(lanes, view.lamp->ofWay[a] / unit), way[a], ofRay);
            }
            lampLightOf(lanes, view.light, certainty, hn::Mul(ofGradient, per), facing, change,
                        hn::Mul(ofRay, perLength), diffuse, specular);
        }
    }
    // In the world.
    HWY_INLINE V square(const V* g) const {
        const auto of = [&](std::size_t k, std::size_t a, std::size_t b) HWY_ATTR {
            return hn::Mul(hn::Set(lanes, view.metric[k] * perAxis[a] * perAxis[b]), g[a]);
        };
        const V alone = hn::MulAdd(of(0, 0, 0), g[0],
                                   hn::MulAdd(of(1, 1, 1), g[1], hn::Mul(of(2, 2, 2), g[2])));
        if (view.isUpright) return alone;
        return hn::MulAdd(of(3, 0, 1), g[1],
                          hn::MulAdd(of(4, 0, 2), g[2], hn::MulAdd(of(5, 1, 2), g[2], alone)));
    }
};

// The gradient by which light falls on a cell, at a place of it, in its units; returns what it is
// along the ray.
template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE V slopesAt(Lanes lanes, const CellSlopes& slopes, const RayParts<Lanes>& r, V* g) {
    const V* const m = r.middle;
    V change = hn::Zero(lanes);
    for (std::size_t a = 0; a < 3; ++a) {
        const auto f = [&](std::size_t k) HWY_ATTR { return hn::Set(lanes, slopes[a][k]); };
        const auto inZ = [&](std::size_t low, std::size_t high)
                             HWY_ATTR { return hn::MulAdd(f(high), m[2], f(low)); };
        const V ofX = hn::MulAdd(inZ(4, 7), m[1], inZ(1, 5));
        g[a] = hn::MulAdd(ofX, m[0], hn::MulAdd(inZ(2, 6), m[1], inZ(0, 3)));
        change = hn::MulAdd(g[a], r.along[a], change);
    }
    return change;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
