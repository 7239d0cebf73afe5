#include "render/splat/seen_splat.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/splat/seen_splat.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include "render/splat/shaped_points-inl.h"
#include "render/splat/splat_forms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr double kFarthest = 1e9;  // pixels: nothing beyond is in any picture

using Words = hn::Rebind<std::uint32_t, Floats>;

// Points and cells of a mesh, one a lane; cells zero where nothing is drawn.
struct MeshPoints {
    alignas(64) float at[3][kLanes];
    alignas(64) double level[kLanes];
    alignas(64) float height[kLanes];
    alignas(64) std::uint32_t clipped[kLanes] = {};  // 1: it is
    ShapedCells<Words> cell;

    HWY_INLINE void take(const timeseries::Mesh::Stored& stored,
                         const timeseries::Mesh::Point* points) {
        const Words words;
        hn::Vec<Words> word[6];
        loadWords(words, points, word);
        for (std::size_t a = 0; a < 3; ++a) hn::Store(placesOf(words, word[a]), Floats(), at[a]);
        cell = cellsOf(words, word);
        const auto inside = hn::Eq(hn::Load(words, clipped), hn::Zero(words));
        auto drawn = hn::RebindMask(Floats(), inside);
        drawn = stored.turned ? hn::And(drawn, cell.turned) : hn::AndNot(cell.turned, drawn);
        for (F& side : cell.diagonal) side = hn::IfThenElseZero(drawn, side);
    }
    void takeLevels(const timeseries::Mesh::Stored& stored, const std::uint32_t* gridIndex) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const auto& of = stored.levels[gridIndex[lane] / stored.points.size()];
            level[lane] = of.at;
            height[lane] = static_cast<float>(of.height);
        }
    }
};

// LowerTriangle, one a lane.
struct Triangles {
    F diagonal[3], below[3];
    F perDiagonal[3];
    HWY_INLINE void solve(const F* v, F* x) const {
        x[0] = hn::Mul(v[0], perDiagonal[0]);
        x[1] = hn::Mul(hn::NegMulAdd(below[0], x[0], v[1]), perDiagonal[1]);
        x[2] = hn::Mul(hn::NegMulAdd(below[1], x[0], hn::NegMulAdd(below[2], x[1], v[2])),
                       perDiagonal[2]);
    }
    // The row of the product of a matrix's row with it.
    HWY_INLINE void times(const F* row, F* out) const {
        out[0] = hn::MulAdd(row[0], diagonal[0],
                            hn::MulAdd(row[1], below[0], hn::Mul(row[2], below[1])));
        out[1] = hn::MulAdd(row[1], diagonal[1], hn::Mul(row[2], below[2]));
        out[2] = hn::Mul(row[2], diagonal[2]);
    }
};

// growthTo() of render/model/ellipsoid.h, of a matrix without products that leave the floats.
HWY_INLINE F growthTo(F least, const Triangles& m) {
    const F squares = hn::Add(dot(m.diagonal, m.diagonal), dot(m.below, m.below));
    const F perRoot = hn::Div(f(1), hn::Sqrt(squares));
    F scaled = hn::Mul(m.diagonal[0], perRoot);
    for (int a = 1; a < 3; ++a) scaled = hn::Mul(scaled, hn::Mul(m.diagonal[a], perRoot));
    const F k = hn::Mul(f(4), hn::Mul(scaled, scaled));
    F t = k;
    for (int i = 0; i < 3; ++i) {
        const F rest = hn::Sub(f(1), t);
        t = hn::Div(k, hn::Mul(rest, rest));
    }
    return hn::Max(hn::NegMulAdd(t, squares, hn::Mul(least, least)), f(0));
}

// factorOf() of timeseries/grid/lower_triangle.h: rows of a triangle, and those of sqrt(g) I beside
// them, are triangular and stay so.
HWY_INLINE Triangles factorOf(const Triangles& m, F g, F least) {
    const F root = hn::Sqrt(g);
    Triangles out;
    const auto ends = [&](int r, F square) HWY_ATTR {
        out.diagonal[r] = hn::Max(hn::Sqrt(square), least);
        out.perDiagonal[r] = hn::Div(f(1), out.diagonal[r]);
    };
    ends(0, hn::MulAdd(m.diagonal[0], m.diagonal[0], g));
    // Unit rows: of the matrix, and beside it.
    const F q00 = hn::Mul(m.diagonal[0], out.perDiagonal[0]);
    const F b00 = hn::Mul(root, out.perDiagonal[0]);
    out.below[0] = hn::Mul(m.below[0], q00);
    F q10 = hn::NegMulAdd(out.below[0], q00, m.below[0]), q11 = m.diagonal[1];
    F b10 = hn::Neg(hn::Mul(out.below[0], b00)), b11 = root;
    const F row1[4] = {q10, q11, b10, b11};
    F square = f(0);
    for (const F& x : row1) square = hn::MulAdd(x, x, square);
    ends(1, square);
    for (F* x : {&q10, &q11, &b10, &b11}) *x = hn::Mul(*x, out.perDiagonal[1]);
    out.below[1] = hn::Mul(m.below[1], q00);
    const F r20 = hn::NegMulAdd(out.below[1], q00, m.below[1]);
    const F r20beside = hn::Neg(hn::Mul(out.below[1], b00));
    out.below[2] = hn::MulAdd(r20, q10, hn::MulAdd(m.below[2], q11, hn::Mul(r20beside, b10)));
    const F row2[6] = {hn::NegMulAdd(out.below[2], q10, r20),
                       hn::NegMulAdd(out.below[2], q11, m.below[2]),
                       m.diagonal[2],
                       hn::NegMulAdd(out.below[2], b10, r20beside),
                       hn::Neg(hn::Mul(out.below[2], b11)),
                       root};
    square = f(0);
    for (const F& x : row2) square = hn::MulAdd(x, x, square);
    ends(2, square);
    return out;
}

// grownTo() of render/model/ellipsoid.h. Few are grown in most pictures, and each is what it is
// whichever are beside it.
HWY_INLINE void growTo(F least, Triangles& m) {
    const F growth = growthTo(least, m);
    const auto grows = hn::Gt(growth, f(0));
    for (int a = 0; a < 3; ++a) m.perDiagonal[a] = hn::Div(f(1), m.diagonal[a]);
    if (hn::AllFalse(Floats(), grows)) return;
    const Triangles grown = factorOf(m, growth, hn::Mul(f(1e-9f), least));
    for (int a = 0; a < 3; ++a) {
        m.diagonal[a] = hn::IfThenElse(grows, grown.diagonal[a], m.diagonal[a]);
        m.below[a] = hn::IfThenElse(grows, grown.below[a], m.below[a]);
        m.perDiagonal[a] = hn::IfThenElse(grows, grown.perDiagonal[a], m.perDiagonal[a]);
    }
}

// Splats that a view sees, one a lane.
struct SeenLanes {
    const TileView& view;
    const MeshPoints& of;
    F depth, windowDepth;
    F centre[2];            // from the view axis
    F whole[2], within[2];  // the centre's pixel in the box, and where in it
    hn::Mask<Floats> drawn;
    F record[kSeenFloats];

    SeenLanes(const TileView& v, const MeshPoints& points) : view(v), of(points) {}
    HWY_INLINE void put(std::size_t field, I x) { record[field] = hn::BitCast(Floats(), x); }

    HWY_INLINE void findPlaces() {
        const std::size_t lanes = hn::Lanes(Doubles());
        SeenHalf half[2];
        D floors[2][2], parts[2][2];
        for (std::size_t h = 0; h < 2; ++h) {
            D along[3];
            for (std::size_t a = 0; a < 3; ++a) {
                const auto at = hn::Load(HalfFloats(), of.at[a] + h * lanes);
                along[a] = hn::MulAdd(hn::PromoteTo(Doubles(), at), d(view.meshScale[a]),
                                      d(view.meshOffset[a]));
            }
            if (view.hasLevels) {
                const D level = hn::Load(Doubles(), of.level + h * lanes);
                along[2] = hn::MulAdd(level, d(view.levelScale), along[2]);
            }
            half[h] = see(view, view.viewFromAxes, along);
            for (std::size_t k = 0; k < 2; ++k) {
                const D window = hn::Add(half[h].centre[k], d(view.centre[k]));
                const auto some = hn::Lt(hn::Abs(window), d(kFarthest));
                floors[k][h] = hn::Floor(hn::IfThenElse(some, window, d(-kFarthest)));
                parts[k][h] = hn::Sub(window, floors[k][h]);
            }
        }
        depth = joined(half[0].depth, half[1].depth);
        windowDepth = joined(half[0].windowDepth, half[1].windowDepth);
        for (std::size_t k = 0; k < 2; ++k) {
            centre[k] = joined(half[0].centre[k], half[1].centre[k]);
            whole[k] = joined(floors[k]);
            within[k] = joined(parts[k]);
            put(kSeenPixel + k, joinedInts(floors[k][0], floors[k][1]));
            record[kSeenWithin + k] = within[k];
        }
        record[kSeenDepth] = windowDepth;
    }

    // Of so many times the cell, grown to what a picture can show.
    HWY_INLINE Triangles factorAndMass(F* mass) {
        Triangles m;
        F cell[3];
        const auto scale = [&](std::size_t row) { return static_cast<float>(view.meshScale[row]); };
        for (std::size_t a = 0; a < 3; ++a) {
            cell[a] = hn::Mul(of.cell.diagonal[a], f(scale(a)));
            const float ofRow = scale(a == 0 ? 1 : 2);
            m.below[a] = hn::Mul(of.cell.below[a], f(view.kernel * ofRow));
        }
        if (view.hasHeights)
            cell[2] =
                hn::Mul(hn::Load(Floats(), of.height), f(static_cast<float>(view.levelScale)));
        drawn = hn::And(hn::Gt(depth, f(view.near)), hn::Le(windowDepth, f(1)));
        for (std::size_t a = 0; a < 3; ++a) {
            drawn = hn::And(drawn, hn::Ne(cell[a], f(0)));
            m.diagonal[a] = hn::Mul(cell[a], f(view.kernel));
        }
        growTo(hn::Mul(depth, f(view.least)), m);
        F share = of.cell.share;
        for (std::size_t a = 0; a < 3; ++a)
            share = hn::Mul(share, hn::Mul(cell[a], m.perDiagonal[a]));
        *mass = hn::Mul(f(view.weight), hn::Abs(share));
        return m;
    }

    HWY_INLINE void findForms(const Triangles& factor, F mass) {
        F ray[3], perX[3], perY[3], c[3], x[3], y[3];
        for (std::size_t a = 0; a < 3; ++a) {
            ray[a] = rayOf(view, centre, a);
            perX[a] = f(view.perPixelX[a]);
            perY[a] = f(view.perPixelY[a]);
        }
        factor.solve(ray, c);
        factor.solve(perX, x);
        factor.solve(perY, y);
        const Forms forms = formsOf(c, x, y, depth);
        for (std::size_t i = 0; i < 3; ++i) record[kSeenN + i] = forms.n[i];
        for (std::size_t i = 0; i < 3; ++i) record[kSeenD + i] = forms.d[i];
        for (std::size_t i = 0; i < 2; ++i) record[kSeenL + i] = forms.l[i];
        record[kSeenWeight] = hn::Mul(hn::Mul(mass, hn::Sqrt(forms.perC2)), faded(view, depth));
    }

    HWY_INLINE void findBox(const Triangles& factor, I* first, I* last) const {
        F row[3][3], lo[2], hi[2];
        for (std::size_t k = 0; k < 3; ++k) {
            F inView[3];
            for (std::size_t a = 0; a < 3; ++a)
                inView[a] = f(static_cast<float>(view.viewFromAxes[a][k]));
            factor.times(inView, row[k]);
        }
        outlineOf(view, depth, centre, row, lo, hi);
        for (std::size_t k = 0; k < 2; ++k) {
            const F limit = f(static_cast<float>(view.box.size[static_cast<int>(k)]));
            const auto pixel = [&](F offset) HWY_ATTR {
                const F at = hn::Ceil(hn::Sub(hn::Add(within[k], offset), f(0.5f)));
                return hn::ConvertTo(Ints(), hn::Min(hn::Max(hn::Add(at, whole[k]), f(0)), limit));
            };
            first[k] = pixel(lo[k]);
            last[k] = pixel(hi[k]);
        }
    }

    HWY_INLINE void findAll(std::span<SeenSplat> splats, std::span<TileSpan> spans) {
        findPlaces();
        F mass;
        const Triangles factor = factorAndMass(&mass);
        findForms(factor, mass);
        I first[2], last[2];
        findBox(factor, first, last);
        for (std::size_t k = 0; k < 2; ++k) {
            drawn = hn::And(drawn, hn::RebindMask(Floats(), hn::Gt(last[k], first[k])));
            put(k ? kSeenRows : kSeenColumns, hn::Or(first[k], hn::ShiftLeft<16>(last[k])));
        }
        writeSpans(first, last, spans);
        write(splats);
    }

    HWY_INLINE void writeSpans(const I* first, const I* last, std::span<TileSpan> spans) const {
        const Ints ints;
        alignas(64) std::int32_t from[2][kLanes], count[2][kLanes];
        for (std::size_t k = 0; k < 2; ++k) {
            const F perTile = f(1 / static_cast<float>(view.tile[static_cast<int>(k)]));
            const auto tileOf = [&](I pixel) HWY_ATTR {  // of its middle, far from a tile's edge
                const F at = hn::Add(hn::ConvertTo(Floats(), pixel), f(0.5f));
                return hn::ConvertTo(ints, hn::Mul(at, perTile));
            };
            // Of what has no place, no number is a tile's.
            const auto some = hn::RebindMask(ints, drawn);
            const I one = hn::Set(ints, 1), begin = hn::IfThenElseZero(some, tileOf(first[k]));
            const I end = hn::Add(tileOf(hn::Sub(last[k], one)), one);
            hn::Store(begin, ints, from[k]);
            hn::Store(hn::IfThenElseZero(some, hn::Sub(end, begin)), ints, count[k]);
        }
        for (std::size_t k = 0; k < spans.size(); ++k)
            spans[k] = {static_cast<std::uint32_t>(from[1][k] * view.tiles.x + from[0][k]),
                        static_cast<std::uint16_t>(count[0][k]),
                        static_cast<std::uint16_t>(count[1][k])};
    }

    HWY_INLINE void write(std::span<SeenSplat> splats) const {
        std::array<SeenSplat, kLanes> beside;  // where there are fewer than lanes
        SeenSplat* const to = splats.size() == kLanes ? splats.data() : beside.data();
        for (std::size_t i = 0; i < kSeenFloats; i += 4)
            storeFours(record + i, [&](std::size_t k) { return floatsOf(to[k]) + i; });
        if (to != splats.data()) std::copy_n(to, splats.size(), splats.data());
    }
};

HWY_ATTR void SeeSplats(const Scene& scene, const TileView& view,
                        std::span<const std::uint32_t> gridIndex,
                        std::span<const timeseries::Mesh::Point> points,
                        std::span<SeenSplat> splats, std::span<TileSpan> spans) {
    const auto stored = scene.placed.mesh()->stored();
    const bool clips = !scene.clip.holdsAll();
    MeshPoints some;
    const auto see = [&](std::size_t i, const timeseries::Mesh::Point* of,
                         const std::uint32_t* index, std::size_t count) HWY_ATTR {
        for (std::size_t k = 0; clips && k < kLanes; ++k)
            some.clipped[k] = !scene.placed.inside(index[k], scene.clip);
        some.take(stored, of);
        if (!stored.levels.empty()) some.takeLevels(stored, index);
        SeenLanes(view, some).findAll(splats.subspan(i, count), spans.subspan(i, count));
    };
    std::size_t i = 0;
    for (; i + kLanes <= gridIndex.size(); i += kLanes)
        see(i, points.data() + i, gridIndex.data() + i, kLanes);
    if (i == gridIndex.size()) return;
    std::array<timeseries::Mesh::Point, kLanes> last;  // and the very last again and again
    std::array<std::uint32_t, kLanes> lastIndex;
    for (std::size_t k = 0; k < kLanes; ++k) {
        const std::size_t at = std::min(i + k, gridIndex.size() - 1);
        last[k] = points[at];
        lastIndex[k] = gridIndex[at];
    }
    see(i, last.data(), lastIndex.data(), gridIndex.size() - i);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(SeeSplats);

void seeSplats(const Scene& scene, const TileView& view, std::span<const std::uint32_t> gridIndex,
               std::span<const timeseries::Mesh::Point> points, std::span<SeenSplat> splats,
               std::span<TileSpan> spans) {
    HWY_DYNAMIC_DISPATCH(SeeSplats)(scene, view, gridIndex, points, splats, spans);
}
}  // namespace render
#endif
