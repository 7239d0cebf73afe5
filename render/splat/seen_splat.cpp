#include "render/splat/seen_splat.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/splat/seen_splat.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include "render/points/grid_indices-inl.h"
#include "render/splat/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kAtOnce = hn::MaxLanes(Doubles());
using DMask = hn::Mask<Doubles>;

// Places and cells of points in the world, one a lane: the factors of LowerTriangle, zero where
// nothing is drawn.
struct MeshPoints {
    alignas(64) double at[3][kAtOnce], diagonal[3][kAtOnce], below[3][kAtOnce];
    void take(const Scene& scene, std::uint32_t gridIndex, std::size_t lane) {
        const PlacedPoints& placed = scene.placed;
        const glm::dvec3 place = placed.position(gridIndex);
        const bool inside = placed.inside(gridIndex, scene.clip);
        const auto cell = inside ? placed.meshCell(gridIndex) : timeseries::LowerTriangle<double>{};
        for (int a = 0; a < 3; ++a) {
            at[a][lane] = place[a];
            diagonal[a][lane] = cell.diagonal[a];
            below[a][lane] = cell.below[a];
        }
    }
};

HWY_INLINE D determinantOf(const MeshPoints& of) {
    D product = d(1);
    for (const auto& a : of.diagonal) product = hn::Mul(product, hn::Load(Doubles(), a));
    return hn::Abs(product);
}

struct Triangles {  // LowerTriangle, one a lane
    D diagonal[3], perDiagonal[3], below[3];
    HWY_INLINE void solve(const D* v, D* x) const {
        x[0] = hn::Mul(v[0], perDiagonal[0]);
        x[1] = hn::Mul(hn::NegMulAdd(below[0], x[0], v[1]), perDiagonal[1]);
        x[2] = hn::Mul(hn::NegMulAdd(below[1], x[0], hn::NegMulAdd(below[2], x[1], v[2])),
                       perDiagonal[2]);
    }
};

// growthTo() of render/model/ellipsoid.h.
HWY_INLINE D growthTo(D least, D product, D squares) {
    const D perRoot = hn::Div(d(1), hn::Sqrt(squares));
    const D scaled = hn::Mul(hn::Mul(product, perRoot), hn::Mul(perRoot, perRoot));
    const D k = hn::Mul(d(4), hn::Mul(scaled, scaled));
    D t = k;
    for (int i = 0; i < 3; ++i) {
        const D rest = hn::Sub(d(1), t);
        t = hn::Div(k, hn::Mul(rest, rest));
    }
    return hn::Max(hn::NegMulAdd(t, squares, hn::Mul(least, least)), d(0));
}

// grownTo() of render/model/ellipsoid.h, of so many times the cells. Their rows, and those of
// sqrt(g) I beside them, are triangular and stay so.
HWY_INLINE Triangles grownTo(D least, const MeshPoints& of, double radius) {
    const Doubles doubles;
    D diagonal[3], below[3];
    for (int a = 0; a < 3; ++a) {
        diagonal[a] = hn::Mul(d(radius), hn::Load(doubles, of.diagonal[a]));
        below[a] = hn::Mul(d(radius), hn::Load(doubles, of.below[a]));
    }
    const D product = hn::Abs(hn::Mul(hn::Mul(diagonal[0], diagonal[1]), diagonal[2]));
    const D squares = hn::Add(dot(diagonal, diagonal), dot(below, below));
    const D g = growthTo(least, product, squares), root = hn::Sqrt(g);
    const D smallest = hn::Mul(d(1e-9), least);
    Triangles out;
    const auto ends = [&](int r, D square) HWY_ATTR {
        out.diagonal[r] = hn::Max(hn::Sqrt(square), smallest);
        out.perDiagonal[r] = hn::Div(d(1), out.diagonal[r]);
    };
    ends(0, hn::MulAdd(diagonal[0], diagonal[0], g));
    // Unit rows: of the matrix, and beside it.
    const D q00 = hn::Mul(diagonal[0], out.perDiagonal[0]);
    const D b00 = hn::Mul(root, out.perDiagonal[0]);
    out.below[0] = hn::Mul(below[0], q00);
    D q10 = hn::NegMulAdd(out.below[0], q00, below[0]), q11 = diagonal[1];
    D b10 = hn::Neg(hn::Mul(out.below[0], b00)), b11 = root;
    const D row1[4] = {q10, q11, b10, b11};
    D square = d(0);
    for (const D& x : row1) square = hn::MulAdd(x, x, square);
    ends(1, square);
    for (D* x : {&q10, &q11, &b10, &b11}) *x = hn::Mul(*x, out.perDiagonal[1]);
    out.below[1] = hn::Mul(below[1], q00);
    const D r20 = hn::NegMulAdd(out.below[1], q00, below[1]);
    const D r20beside = hn::Neg(hn::Mul(out.below[1], b00));
    out.below[2] = hn::MulAdd(r20, q10, hn::MulAdd(below[2], q11, hn::Mul(r20beside, b10)));
    const D row2[6] = {hn::NegMulAdd(out.below[2], q10, r20),
                       hn::NegMulAdd(out.below[2], q11, below[2]),
                       diagonal[2],
                       hn::NegMulAdd(out.below[2], b10, r20beside),
                       hn::Neg(hn::Mul(out.below[2], b11)),
                       root};
    square = d(0);
    for (const D& x : row2) square = hn::MulAdd(x, x, square);
    ends(2, square);
    return out;
}

// A splat in pixels, one a lane, as in Splat.
struct Seen {
    D centre[2], lo[2], hi[2], n[3], d[3], l[2], weight;
};

// sphereExtent(), infinite where the outline reaches behind the eye.
HWY_INLINE D extentOf(D depth, D radius, D tan) {
    const D cos = hn::Div(d(1), hn::Sqrt(hn::MulAdd(tan, tan, d(1))));
    const D sin = hn::Mul(hn::Div(radius, depth), cos);
    const D sin2 = hn::Mul(sin, sin);
    const D cosSum = hn::NegMulAdd(hn::Mul(tan, cos), sin,
                                   hn::Mul(cos, hn::Sqrt(hn::Max(hn::Sub(d(1), sin2), d(0)))));
    return hn::IfThenElse(hn::And(hn::Lt(sin, d(1)), hn::Gt(cosSum, d(0))),
                          hn::Div(sin, hn::Mul(cos, cosSum)),
                          d(std::numeric_limits<double>::infinity()));
}

// narrow() of render/model/footprint.h.
HWY_INLINE void narrow(Seen& s) {
    const D well = d(1e-4), half = d(0.5);
    D m[3];
    for (int k = 0; k < 3; ++k) m[k] = hn::Sub(s.n[k], s.d[k]);
    const D area = hn::Mul(m[0], m[2]), lean = hn::Mul(half, m[1]);
    const D det = hn::NegMulAdd(lean, lean, area);
    const DMask tells =
        hn::And(hn::And(hn::Gt(m[0], hn::Mul(well, s.n[0])), hn::Gt(m[2], hn::Mul(well, s.n[2]))),
                hn::Gt(det, hn::Mul(well, area)));
    const D perDet = hn::Div(d(1), det), perTwo = hn::Mul(half, perDet);
    const D middle[2] = {hn::Mul(hn::NegMulAdd(lean, s.l[1], hn::Mul(m[2], s.l[0])), perTwo),
                         hn::Mul(hn::NegMulAdd(lean, s.l[0], hn::Mul(m[0], s.l[1])), perTwo)};
    const D level =
        hn::MulAdd(half, hn::MulAdd(s.l[0], middle[0], hn::Mul(s.l[1], middle[1])), d(1));
    for (int k = 0; k < 2; ++k) {
        const D reach =
            hn::MulAdd(hn::Sqrt(hn::Mul(hn::Mul(level, perDet), m[2 - 2 * k])), d(1.001), d(0.01));
        s.lo[k] = hn::IfThenElse(tells, hn::Max(s.lo[k], hn::Sub(middle[k], reach)), s.lo[k]);
        s.hi[k] = hn::IfThenElse(tells, hn::Min(s.hi[k], hn::Add(middle[k], reach)), s.hi[k]);
    }
}

// splatAt() of render/model/footprint.h, the depths of whose centres are known.
HWY_INLINE Seen see(const PointsView& view, double radius, const MeshPoints& of, const D* inView,
                    D depth) {
    const D perDepth = hn::Div(d(1), depth);
    const Triangles factor = grownTo(hn::Mul(depth, d(view.smallestRadius)), of, radius);
    Seen s;
    D ray[3], perX[3], perY[3], c[3], x[3], y[3], across[3], other[3], tan2 = d(0);
    for (int k = 0; k < 2; ++k) {
        const D tan = hn::Mul(inView[k], perDepth);
        tan2 = hn::MulAdd(tan, tan, tan2);
        s.centre[k] = hn::Mul(tan, d(view.rays.focal[k]));
    }
    for (int a = 0; a < 3; ++a) {
        perX[a] = d(view.rays.perPixelX[a]);
        perY[a] = d(view.rays.perPixelY[a]);
        ray[a] = hn::MulAdd(s.centre[0], perX[a],
                            hn::MulAdd(s.centre[1], perY[a], d(view.rays.axis[a])));
    }
    factor.solve(ray, c);
    factor.solve(perX, x);
    factor.solve(perY, y);
    cross(c, x, across);
    cross(c, y, other);
    const D perC2 = hn::Div(d(1), dot(c, c)), two = d(2);
    const D scale = hn::Mul(hn::Mul(depth, depth), perC2);
    s.n[0] = hn::Mul(scale, dot(across, across));
    s.n[1] = hn::Mul(hn::Mul(two, scale), dot(across, other));
    s.n[2] = hn::Mul(scale, dot(other, other));
    s.d[0] = hn::Mul(perC2, dot(x, x));
    s.d[1] = hn::Mul(hn::Mul(two, perC2), dot(x, y));
    s.d[2] = hn::Mul(perC2, dot(y, y));
    s.l[0] = hn::Mul(hn::Mul(two, perC2), dot(c, x));
    s.l[1] = hn::Mul(hn::Mul(two, perC2), dot(c, y));
    const D fade =
        hn::Min(hn::Max(hn::Sub(hn::Mul(depth, d(1 / view.rays.near)), d(1)), d(0)), d(1));
    const D perSides =
        hn::Mul(hn::Mul(factor.perDiagonal[0], factor.perDiagonal[1]), factor.perDiagonal[2]);
    s.weight = hn::Mul(hn::Mul(hn::Mul(determinantOf(of), perSides), hn::Sqrt(perC2)),
                       hn::Mul(hn::Mul(fade, fade), hn::NegMulAdd(two, fade, d(3))));
    const D widest =
        hn::Sqrt(hn::Add(dot(factor.diagonal, factor.diagonal), dot(factor.below, factor.below)));
    const D extent = hn::Mul(
        extentOf(depth, hn::Mul(widest, d(view.lengthening.most / view.rayLength)), hn::Sqrt(tan2)),
        d(std::max(view.rays.focal.x, view.rays.focal.y)));
    for (int k = 0; k < 2; ++k) s.lo[k] = hn::Neg(s.hi[k] = extent);
    narrow(s);
    return s;
}

// As they are kept.
HWY_INLINE void write(const TileLayout& layout, const Seen& s, D weight, D depth, DMask drawn,
                      std::span<SeenSplat> to) {
    const HalfInts ints;
    const hn::Rebind<float, Doubles> floats;
    // An outline that reaches behind the eye has no bounds; what is as far aside takes nothing.
    const D far = d(1e9);
    constexpr std::size_t kFields = sizeof(SeenSplat) / sizeof(float);
    alignas(64) float field[kFields][kAtOnce];
    alignas(64) std::int32_t pixel[2][kAtOnce];
    std::size_t next = 0;
    const auto keep = [&](D x)
                          HWY_ATTR { hn::Store(hn::DemoteTo(floats, x), floats, field[next++]); };
    D within[2];
    for (std::size_t k = 0; k < 2; ++k) {
        const D window = hn::Add(s.centre[k], d(layout.centre[k]));
        drawn = hn::And(drawn, hn::Lt(hn::Abs(window), far));
        const D whole = hn::Floor(hn::IfThenElseZero(drawn, window));
        within[k] = hn::Sub(window, whole);
        hn::Store(hn::DemoteTo(ints, whole), ints, pixel[k]);
    }
    for (const D& x : within) keep(x);
    for (const D& x : s.lo) keep(hn::IfThenElseZero(drawn, hn::Max(x, hn::Neg(far))));
    for (const D& x : s.hi) keep(hn::IfThenElseZero(drawn, hn::Min(x, far)));
    for (const D& x : s.n) keep(x);
    for (const D& x : s.d) keep(x);
    for (const D& x : s.l) keep(x);
    keep(weight);
    keep(depth);
    for (std::size_t k = 0; k < to.size(); ++k) {
        const auto of = [&](std::size_t i) { return field[i][k]; };
        to[k] = {{pixel[0][k], pixel[1][k]},
                 {of(0), of(1)},
                 {of(2), of(3)},
                 {of(4), of(5)},
                 {of(6), of(7), of(8)},
                 {of(9), of(10), of(11)},
                 {of(12), of(13)},
                 of(14),
                 of(15)};
    }
}

HWY_ATTR void SeeSplats(const Scene& scene, const TileLayout& layout, const PointsView& view,
                        double factor, std::span<const std::uint32_t> gridIndex,
                        std::span<SeenSplat> splats) {
    constexpr std::size_t kAhead = 12;
    const Doubles doubles;
    const double radius = kQuarticRadius * scene.footprint.size;
    const D mass =
        d(5 / std::numbers::pi / view.unitLength * factor * scene.placed.volumePerDeterminant());
    MeshPoints some;
    for (std::size_t i = 0; i < gridIndex.size(); i += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, gridIndex.size() - i);
        for (std::size_t k = 0; k < kAtOnce; ++k) {
            if (i + k + kAhead < gridIndex.size()) scene.placed.prefetch(gridIndex[i + k + kAhead]);
            some.take(scene, gridIndex[i + std::min(k, count - 1)], k);
        }
        D at[3], inView[3];
        for (int a = 0; a < 3; ++a) at[a] = hn::Load(doubles, some.at[a]);
        for (int a = 0; a < 3; ++a) {
            const auto& m = view.viewFromWorld;
            inView[a] = hn::MulAdd(
                at[0], d(m[0][a]),
                hn::MulAdd(at[1], d(m[1][a]), hn::MulAdd(at[2], d(m[2][a]), d(m[3][a]))));
        }
        const D depth = hn::Neg(inView[2]);
        const D windowDepth = hn::Add(hn::Div(d(layout.depthA), depth), d(layout.depthB));
        const Seen s = see(view, radius, some, inView, depth);
        const DMask drawn =
            hn::And(hn::Gt(determinantOf(some), d(0)),
                    hn::And(hn::Gt(depth, d(view.rays.near)), hn::Le(windowDepth, d(1))));
        write(layout, s, hn::Mul(s.weight, mass), windowDepth, drawn, splats.subspan(i, count));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(SeeSplats);

void seeSplats(const Scene& scene, const TileLayout& layout, const PointsView& view, double factor,
               std::span<const std::uint32_t> gridIndex, std::span<SeenSplat> splats) {
    HWY_DYNAMIC_DISPATCH(SeeSplats)(scene, layout, view, factor, gridIndex, splats);
}
}  // namespace render
#endif
