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
    // Of uneven ones: |d - 1| on its pixels, at most. Of Over: its optical depth there, at most.
    alignas(64) float change[kLanes], mostDepth[kLanes];
    alignas(64) float weight[kLanes], depth[kLanes], red[kLanes], green[kLanes], blue[kLanes];
    alignas(64) std::int32_t x[kLanes], y[kLanes], columns[kLanes], rows[kLanes];
    const SplatCut* cut[kLanes];  // of those that may end at the domain's faces
};

HWY_INLINE F volume(const TileView& view, const Points& p) {
    F sides[3];
    sidesOf(view, p, sides);
    return hn::Mul(hn::Mul(sides[0], sides[1]), sides[2]);
}

// How far from 1 an uneven splat's d comes on its pixels and on those that make a vector whole;
// slanted: of forms in (x + m y, y).
HWY_INLINE void setUpChange(bool slanted, Batch& out) {
    const Floats floats;
    constexpr float kBeside = 16;
    const auto of = [&](const float* v) HWY_ATTR { return hn::Load(floats, v); };
    const auto farthest = [&](const float* first, const std::int32_t* count,
                              float beside) HWY_ATTR {
        const F last = hn::Add(of(first), hn::ConvertTo(floats, hn::Load(Ints(), count)));
        return hn::Max(hn::Abs(of(first)), hn::Abs(hn::Add(last, f(beside))));
    };
    const F y = farthest(out.oy, out.rows, 0);
    F x = farthest(out.ox, out.columns, kBeside);
    if (slanted) x = hn::MulAdd(hn::Abs(of(out.nxy)), y, x);
    const F alongX = hn::Mul(x, hn::MulAdd(x, of(out.dxx), hn::Abs(of(out.lx))));
    const F alongY = hn::Mul(y, hn::MulAdd(y, of(out.dyy), hn::Abs(of(out.ly))));
    const F both = hn::Mul(hn::Mul(x, y), hn::Abs(of(out.dxy)));
    hn::Store(hn::Add(both, hn::Add(alongX, alongY)), floats, out.change);
}

HWY_INLINE void keepForm(const F* n, Batch& out) {
    float* const to[] = {out.nxx, out.nxy, out.nyy};
    for (std::size_t i = 0; i < 3; ++i) hn::Store(n[i], Floats(), to[i]);
}
HWY_INLINE void keepForms(const Forms& forms, bool slanted, Batch& out) {
    keepForm(forms.n, out);
    float* const d[] = {out.dxx, out.dxy, out.dyy};
    for (std::size_t i = 0; i < 3; ++i) hn::Store(forms.d[i], Floats(), d[i]);
    hn::Store(forms.l[0], Floats(), out.lx);
    hn::Store(forms.l[1], Floats(), out.ly);
    setUpChange(slanted, out);
}

// Where the ray is that much of them, of even splats. Returns what they weigh.
HWY_INLINE F setUpEven(const TileView& view, const Points& p, Batch& out) {
    const F x = p.centre[0], y = p.centre[1];
    const F perGrown = hn::Div(f(1), growth(view, p)), scale = hn::Mul(p.depth, perGrown);
    const F scale2 = hn::Mul(scale, scale);
    const auto square = [&](const std::array<float, 3>& c, F at) HWY_ATTR {
        return hn::MulAdd(hn::MulAdd(f(c[2]), at, f(c[1])), at, f(c[0]));
    };
    const F xy = hn::MulAdd(hn::MulAdd(f(view.nxy[3]), y, f(view.nxy[1])), x,
                            hn::MulAdd(f(view.nxy[2]), y, f(view.nxy[0])));
    const F n[3] = {hn::Mul(scale2, square(view.nxx, y)), hn::Mul(scale2, xy),
                    hn::Mul(scale2, square(view.nyy, x))};
    keepForm(n, out);
    return hn::Mul(f(view.weight), hn::Mul(perGrown, perGrown));
}

HWY_INLINE F setUpUneven(const TileView& view, const Points& p, Batch& out) {
    F c[3], x[3], y[3], sides[3], semiAxes[3], weight = f(view.weight);
    sidesOf(view, p, sides);
    semiAxesOf(view, p, semiAxes);
    for (std::size_t a = 0; a < 3; ++a) {
        const F perSemiAxis = hn::Div(f(1), semiAxes[a]);
        weight = hn::Mul(weight, hn::Mul(sides[a], perSemiAxis));
        c[a] = hn::Mul(rayOf(view, p.centre, a), perSemiAxis);
        x[a] = hn::Mul(f(view.perPixelX[a]), perSemiAxis);
        y[a] = hn::Mul(f(view.perPixelY[a]), perSemiAxis);
    }
    const Forms forms = formsOf(c, x, y, p.depth);
    keepForms(forms, false, out);
    return hn::Mul(weight, hn::Sqrt(forms.perC2));
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
    F record[kSeenFloats];
    for (std::size_t i = 0; i < kSeenFloats; i += 4)
        loadFours([&](std::size_t k) { return floatsOf(view.seenSplats[index[k]]) + i; },
                  record + i);
    const auto whole = [&](std::size_t field) HWY_ATTR { return hn::BitCast(ints, record[field]); };
    const I columns = whole(kSeenColumns), rows = whole(kSeenRows);
    float* const offset[2] = {out.ox, out.oy};
    std::int32_t* const begin[2] = {out.x, out.y};
    std::int32_t* const count[2] = {out.columns, out.rows};
    for (std::size_t k = 0; k < 2; ++k) {
        const int c = static_cast<int>(k);
        const auto within = [&](I pixel) HWY_ATTR {
            return hn::Min(hn::Max(hn::Sub(pixel, hn::Set(ints, at[c])), hn::Zero(ints)),
                           hn::Set(ints, size[c]));
        };
        const I span = k ? rows : columns;
        const I first = within(hn::And(span, hn::Set(ints, 0xffff)));
        const hn::RebindToUnsigned<Ints> words;  // 2^15 has the sign's bit
        const I last = within(hn::BitCast(ints, hn::ShiftRight<16>(hn::BitCast(words, span))));
        hn::Store(first, ints, begin[k]);
        hn::Store(hn::Sub(last, first), ints, count[k]);
        const F centre =
            hn::ConvertTo(floats, hn::Sub(whole(kSeenPixel + k), hn::Set(ints, at[c])));
        hn::Store(hn::Sub(hn::Sub(hn::ConvertTo(floats, first), centre),
                          hn::Sub(record[kSeenWithin + k], f(0.5f))),
                  floats, offset[k]);
    }
    Forms forms;
    for (std::size_t i = 0; i < 3; ++i) forms.n[i] = record[kSeenN + i];
    for (std::size_t i = 0; i < 3; ++i) forms.d[i] = record[kSeenD + i];
    for (std::size_t i = 0; i < 2; ++i) forms.l[i] = record[kSeenL + i];
    keepForms(forms, view.endsAtFaces, out);
    hn::Store(record[kSeenWeight], floats, out.weight);
    hn::Store(record[kSeenDepth], floats, out.depth);
}

// What splats are: squares of whole pixels; spheres or other ellipsoids that are all alike, whose
// factor is everywhere the same or a pixel's; or others, which may end at the domain's faces.
enum class Shape { Square, Sphere, Even, Uneven, Cut };
constexpr bool isUneven(Shape shape) { return shape == Shape::Uneven || shape == Shape::Cut; }
constexpr bool mayBeSeenBefore(Shape shape) { return isUneven(shape) || shape == Shape::Square; }

template <Shape kShape>
HWY_INLINE void setUp(const TileView& view, const std::uint32_t* words, const float* tints,
                      glm::ivec2 at, glm::ivec2 size, Batch& out) {
    F weight;
    if (mayBeSeenBefore(kShape) && view.isSeenBefore) {
        takeSeen(view, words, at, size, out);
        weight = hn::Load(Floats(), out.weight);
        if constexpr (kShape == Shape::Cut)
            for (std::size_t k = 0; k < kLanes; ++k) out.cut[k] = &view.cuts[words[k]];
    } else {
        const Points p = see(view, words, kShape == Shape::Square ? glm::ivec2(0) : at);
        setUpBox(view, p, at, size, out);
        if constexpr (kShape == Shape::Square)
            weight =
                hn::Mul(hn::Mul(f(view.weight), volume(view, p)), hn::Mul(p.perDepth, p.perDepth));
        else
            weight = isUneven(kShape) ? setUpUneven(view, p, out) : setUpEven(view, p, out);
        weight = hn::Mul(weight, faded(view, p.depth));
    }
    if (tints != nullptr) weight = hn::Mul(weight, setUpTints(view, tints, out));
    hn::Store(weight, Floats(), out.weight);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
