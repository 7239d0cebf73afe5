// What the splats of a batch add to the pixels of a tile. Compiled once for each of Highway's
// targets, so not guarded as other headers are.
#if defined(RENDER_TILE_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_TILE_PIXELS_INL_H_
#undef RENDER_TILE_PIXELS_INL_H_
#else
#define RENDER_TILE_PIXELS_INL_H_
#endif

#include <limits>

#include "render/model/footprint.h"
#include "render/splat/lanes-inl.h"
#include "render/splat/tile_batch-inl.h"
#include "render/splat/tile_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// What a splat adds to a vector of pixels whose share of it is t, from this place of the sums on.
template <class Lanes>
struct AddWeight {
    Lanes lanes;
    hn::Vec<Lanes> weight;
    float* HWY_RESTRICT sums;
    AddWeight(Lanes l, const Batch& b, std::size_t k, TileRoom& room)
        : lanes(l), weight(hn::Set(l, b.weight[k])), sums(room.sums.data()) {}
    HWY_INLINE void operator()(hn::Vec<Lanes> t, std::size_t at) const {
        hn::StoreU(hn::MulAdd(t, weight, hn::LoadU(lanes, sums + at)), lanes, sums + at);
    }
};

// Of Count: one where it has any.
template <class Lanes>
struct AddOne {
    Lanes lanes;
    float* HWY_RESTRICT sums;
    AddOne(Lanes l, TileRoom& room) : lanes(l), sums(room.sums.data()) {}
    HWY_INLINE void operator()(hn::Vec<Lanes> t, std::size_t at) const {
        const auto one = hn::IfThenElseZero(hn::Gt(t, hn::Zero(lanes)), hn::Set(lanes, 1.0f));
        hn::StoreU(hn::Add(one, hn::LoadU(lanes, sums + at)), lanes, sums + at);
    }
};

template <class Lanes>
struct AddColor {
    Lanes lanes;
    hn::Vec<Lanes> channel[4];
    float* HWY_RESTRICT sums;
    std::size_t plane;
    AddColor(Lanes l, const Batch& b, std::size_t k, TileRoom& room)
        : lanes(l), sums(room.sums.data()), plane(room.plane) {
        const auto weight = hn::Set(l, b.weight[k]);
        channel[0] = hn::Mul(weight, hn::Set(l, b.red[k]));
        channel[1] = hn::Mul(weight, hn::Set(l, b.green[k]));
        channel[2] = hn::Mul(weight, hn::Set(l, b.blue[k]));
        channel[3] = weight;
    }
    HWY_INLINE void operator()(hn::Vec<Lanes> t, std::size_t at) const {
        for (std::size_t c = 0; c < 4; ++c) {
            float* const to = sums + c * plane + at;
            hn::StoreU(hn::MulAdd(t, channel[c], hn::LoadU(lanes, to)), lanes, to);
        }
    }
};

// Without factors the depth has them in it.
template <class Lanes, bool kSmall, bool kFactors>
struct LayUnder {
    Lanes lanes;
    hn::Vec<Lanes> color[3], depth;  // optical
    float* HWY_RESTRICT sums;
    const float* HWY_RESTRICT factor;
    std::size_t plane;
    LayUnder(Lanes l, const Batch& b, std::size_t k, TileRoom& room)
        : lanes(l),
          depth(hn::Set(l, b.weight[k])),
          sums(room.sums.data()),
          factor(room.factor.data()),
          plane(room.plane) {
        color[0] = hn::Set(l, b.red[k]);
        color[1] = hn::Set(l, b.green[k]);
        color[2] = hn::Set(l, b.blue[k]);
    }
    HWY_INLINE void operator()(hn::Vec<Lanes> t, std::size_t at) const {
        auto x = hn::Mul(t, depth);
        if constexpr (kFactors) x = hn::Mul(x, hn::LoadU(lanes, factor + at));
        layUnder<kSmall>(PixelRow<Lanes>(), lanes, x, color, sums + at, plane);
    }
};

// The footprints that q = n / d has: of even splats d is the ray's; of splats that are narrow
// beside their distance it is so near 1 that a series tells 1 / sqrt(d) as well as floats can.
// Cut: of any that may end at a face, and is slim.
enum class Form { Even, Narrow, Any, Cut };
constexpr float kNarrow = 1.0f / 32;  // |d - 1|, at most: what is left out is below 3e-7

// oddPolynomial() of the clamped.
template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE V alongRay(Lanes lanes, V at) {
    const V one = hn::Set(lanes, 1.0f);
    const V u = hn::Min(hn::Max(at, hn::Neg(one)), one), u2 = hn::Mul(u, u);
    V sum = hn::Zero(lanes);
    for (int k = 6; k >= 0; --k)
        sum = hn::MulAdd(sum, u2, hn::Set(lanes, static_cast<float>(kAlongRay[k])));
    return hn::Mul(sum, u);
}

// Splat::insideShare() at these offsets. `rest` is 1 - q, above 0 where it matters.
template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE V insideShare(Lanes lanes, const SplatCut& cut, V ox, V oy, V rest) {
    const auto set = [&](float x) HWY_ATTR { return hn::Set(lanes, x); };
    const V never = set(std::numeric_limits<float>::max()), least = set(1e-20f);
    V from = hn::Neg(never), to = never, dd = hn::Zero(lanes), hd = dd;
    for (std::size_t a = 0; a < 3; ++a) {
        const V added = hn::MulAdd(ox, set(cut.x[a]), hn::Mul(oy, set(cut.y[a])));
        const V h = hn::Mul(set(cut.depth), added), along = hn::Add(set(cut.c[a]), added);
        dd = hn::MulAdd(along, along, dd);
        hd = hn::MulAdd(h, along, hd);
        const V per = hn::Div(set(1), hn::IfThenElse(hn::Lt(hn::Abs(along), least), least, along));
        const V one = hn::Mul(hn::Sub(set(cut.loFace[a]), h), per);
        const V other = hn::Mul(hn::Sub(set(cut.hiFace[a]), h), per);
        from = hn::Max(from, hn::Min(one, other));
        to = hn::Min(to, hn::Max(one, other));
    }
    const V nearest = hn::Div(hn::Neg(hd), dd), perHalf = hn::Sqrt(hn::Div(dd, rest));
    const V first = hn::Sub(from, nearest), last = hn::Max(hn::Sub(to, nearest), first);
    return hn::Mul(set(0.5f), hn::Sub(alongRay(lanes, hn::Mul(last, perHalf)),
                                      alongRay(lanes, hn::Mul(first, perHalf))));
}

// Of a splat's box in a tile, the pixels [first, last) of each row that it may touch: few, of a
// large one that is slim.
struct RowSpans {
    static constexpr std::size_t kRows = 64;
    alignas(64) std::int32_t first[kRows], last[kRows];
};
// False where that is not worth asking.
HWY_INLINE bool findSpans(const Batch& b, std::size_t k, RowSpans& spans) {
    const Floats floats;
    const F columns = f(static_cast<float>(b.columns[k]));
    const float along = b.nxx[k] - b.dxx[k];
    constexpr int kSmall = 2 * static_cast<int>(kLanes);
    if (b.columns[k] <= kSmall || !(along > 1e-3f * b.nxx[k])) return false;
    const F steps = hn::ConvertTo(floats, hn::Iota(Ints(), 0));
    for (int row = 0; row < b.rows[k]; row += static_cast<int>(kLanes)) {
        // Where n - d <= 0; a pixel more on both sides for rounding.
        const F y = hn::Add(f(b.oy[k] + static_cast<float>(row)), steps);
        const F half = hn::Mul(f(-0.5f), hn::MulAdd(f(b.dxy[k]), y, f(b.lx[k])));
        const F rest =
            hn::Sub(hn::Mul(hn::Sub(hn::Mul(f(b.nyy[k] - b.dyy[k]), y), f(b.ly[k])), y), f(1));
        const F root =
            hn::Sqrt(hn::Max(hn::NegMulAdd(f(along), rest, hn::Mul(half, half)), hn::Zero(floats)));
        const F per = f(1 / along);
        const auto pixel = [&](F end) HWY_ATTR {
            return hn::NegMulAdd(f(b.nxy[k]), y,
                                 hn::Sub(hn::Mul(hn::Sub(end, half), per), f(b.ox[k])));
        };
        const auto within = [&](F at) HWY_ATTR {
            return hn::Min(hn::Max(at, hn::Zero(floats)), columns);
        };
        const F first = within(hn::Sub(hn::Floor(pixel(hn::Neg(root))), f(1)));
        const F last = within(hn::Add(hn::Ceil(pixel(root)), f(2)));
        hn::Store(hn::ConvertTo(Ints(), first), Ints(), spans.first + row);
        hn::Store(hn::ConvertTo(Ints(), last), Ints(), spans.last + row);
    }
    return true;
}

// What of a splat's weight the pixels of its box take: (1 - q)^4, / sqrt(d) where it is not even,
// its share before a face, nothing where the opaque scene hides it, and exactly nothing beside the
// footprint.
template <Form kForm, bool kHidden, class Lanes, class Sink>
HWY_INLINE void forPixels(Lanes lanes, const Batch& b, std::size_t k, const TileRoom& room,
                          const Sink& sink) {
    using V = hn::Vec<Lanes>;
    constexpr int kStep = static_cast<int>(hn::MaxLanes(Lanes()));
    const V one = hn::Set(lanes, 1.0f), zero = hn::Zero(lanes);
    const V least = hn::Set(lanes, kLeastDenominator);
    const auto set = [&](float x) HWY_ATTR { return hn::Set(lanes, x); };
    const V nyy = set(b.nyy[k]), dyy = set(kForm == Form::Even ? 0.0f : b.dyy[k]);
    const V depth = hn::Set(lanes, b.depth[k]);
    const V steps = hn::ConvertTo(lanes, hn::Iota(hn::RebindToSigned<Lanes>(), 0));
    const int columns = b.columns[k], rows = b.rows[k];
    const float* HWY_RESTRICT perRay2 = room.perRay2.data();
    const float* HWY_RESTRICT opaque = room.opaque.data();
    RowSpans spans;
    const bool hasSpans = kForm == Form::Cut && findSpans(b, k, spans);
    for (int i = 0; i < columns; i += kStep) {
        const V ox = hn::Add(hn::Set(lanes, b.ox[k] + static_cast<float>(i)), steps);
        const V n0 = hn::Mul(hn::Mul(hn::Set(lanes, b.nxx[k]), ox), ox);
        const V n1 = hn::Mul(hn::Set(lanes, b.nxy[k]), ox);
        V e0 = zero, e1 = zero;  // of d - 1
        if constexpr (kForm != Form::Even) {
            e0 = hn::Mul(hn::MulAdd(set(b.dxx[k]), ox, set(b.lx[k])), ox);
            e1 = hn::MulAdd(set(b.dxy[k]), ox, set(b.ly[k]));
        }
        auto at = static_cast<std::size_t>(b.y[k] * kTileStride + b.x[k] + i);
        V oy = hn::Set(lanes, b.oy[k]);
        for (int row = 0; row < rows; ++row, at += kTileStride, oy = hn::Add(oy, one)) {
            if (hasSpans && (i >= spans.last[row] || i + kStep <= spans.first[row])) continue;
            V n, e = zero;
            if constexpr (kForm == Form::Cut) {
                const V u = hn::MulAdd(set(b.nxy[k]), oy, ox);
                n = hn::MulAdd(hn::Mul(set(b.nxx[k]), u), u, hn::Mul(hn::Mul(nyy, oy), oy));
                e = hn::MulAdd(hn::MulAdd(dyy, oy, hn::MulAdd(set(b.dxy[k]), u, set(b.ly[k]))), oy,
                               hn::Mul(hn::MulAdd(set(b.dxx[k]), u, set(b.lx[k])), u));
            } else {
                n = hn::MulAdd(hn::MulAdd(nyy, oy, n1), oy, n0);
                if constexpr (kForm != Form::Even) e = hn::MulAdd(hn::MulAdd(dyy, oy, e1), oy, e0);
            }
            V t;
            if constexpr (kForm == Form::Even) {
                t = hn::Max(hn::NegMulAdd(n, hn::LoadU(lanes, perRay2 + at), one), zero);
                t = hn::Mul(t, t);
                t = hn::Mul(t, t);
            } else {
                const V d = hn::Add(e, one);
                V root;
                if constexpr (kForm == Form::Narrow)
                    root = hn::MulAdd(
                        hn::MulAdd(hn::MulAdd(set(-0.3125f), e, set(0.375f)), e, set(-0.5f)), e,
                        one);
                else
                    root = reciprocalRoot(lanes, hn::Max(d, least));
                // Of a slim splat what is left of n may be below 0.
                const V rest =
                    hn::Max(hn::NegMulAdd(hn::Mul(hn::Max(n, zero), root), root, one), zero);
                t = hn::Mul(rest, rest);
                t = hn::Mul(hn::Mul(t, t), root);
                auto some = hn::Gt(d, least);
                if constexpr (kForm == Form::Cut) {
                    some = hn::And(some, hn::Gt(rest, zero));
                    if (hn::AllFalse(lanes, some)) continue;
                    if (b.cut[k]->depth > 0)
                        t = hn::Mul(t, insideShare(lanes, *b.cut[k], ox, oy, rest));
                }
                if constexpr (kForm != Form::Narrow) t = hn::IfThenElseZero(some, t);
            }
            if constexpr (kHidden)
                t = hn::IfThenElseZero(hn::Le(depth, hn::LoadU(lanes, opaque + at)), t);
            sink(t, at);
        }
    }
}

// A point splat is the same on all of its pixels.
template <class Lanes, class Sink>
HWY_INLINE void forSquare(Lanes lanes, const Batch& b, std::size_t k, const TileRoom& room,
                          bool hidden, const Sink& sink) {
    constexpr int kStep = static_cast<int>(hn::MaxLanes(Lanes()));
    const auto depth = hn::Set(lanes, b.depth[k]), one = hn::Set(lanes, 1.0f);
    const auto columns = static_cast<std::size_t>(std::max(b.columns[k], 0));
    for (std::size_t i = 0; i < columns; i += kStep) {
        const auto some = hn::FirstN(lanes, std::min<std::size_t>(columns - i, kStep));
        auto at = static_cast<std::size_t>(b.y[k] * kTileStride + b.x[k]) + i;
        for (int row = 0; row < b.rows[k]; ++row, at += kTileStride) {
            auto t = hn::IfThenElseZero(some, one);
            if (hidden)
                t = hn::IfThenElseZero(hn::Le(depth, hn::LoadU(lanes, room.opaque.data() + at)), t);
            sink(t, at);
        }
    }
}

template <Form kForm, class Lanes, class Sink>
HWY_INLINE void addForm(Lanes lanes, const Batch& b, std::size_t k, TileRoom& room,
                        const Sink& sink) {
    return b.depth[k] > room.nearestOpaque ? forPixels<kForm, true>(lanes, b, k, room, sink)
                                           : forPixels<kForm, false>(lanes, b, k, room, sink);
}

template <Shape kShape, class Lanes, class Sink>
HWY_INLINE void addSplat(Lanes lanes, const Batch& b, std::size_t k, TileRoom& room,
                         const Sink& sink) {
    if constexpr (kShape == Shape::Square)
        return forSquare(lanes, b, k, room, b.depth[k] > room.nearestOpaque, sink);
    else if constexpr (kShape == Shape::Cut)
        return addForm<Form::Cut>(lanes, b, k, room, sink);
    else if constexpr (kShape != Shape::Uneven)
        return addForm<Form::Even>(lanes, b, k, room, sink);
    else
        return b.change[k] <= kNarrow ? addForm<Form::Narrow>(lanes, b, k, room, sink)
                                      : addForm<Form::Any>(lanes, b, k, room, sink);
}

template <Channels kChannels, Shape kShape, class Lanes>
HWY_INLINE void addSplat(Lanes lanes, const Batch& b, std::size_t k, TileRoom& room) {
    if constexpr (kChannels == Channels::Weight)
        return addSplat<kShape>(lanes, b, k, room, AddWeight<Lanes>(lanes, b, k, room));
    else if constexpr (kChannels == Channels::WeightedColor)
        return addSplat<kShape>(lanes, b, k, room, AddColor<Lanes>(lanes, b, k, room));
    else if constexpr (kChannels == Channels::Count)
        return addSplat<kShape>(lanes, b, k, room, AddOne<Lanes>(lanes, room));
    else if (constexpr bool kFactors = kShape != Shape::Sphere; b.mostDepth[k] <= 0.5f)
        addSplat<kShape>(lanes, b, k, room, LayUnder<Lanes, true, kFactors>(lanes, b, k, room));
    else
        addSplat<kShape>(lanes, b, k, room, LayUnder<Lanes, false, kFactors>(lanes, b, k, room));
}

// Over: the optical depths that splats give a pixel, at most; of spheres in the middle.
template <Shape kShape>
HWY_INLINE void setUpDepth(const TileRoom& room, Batch& b) {
    const Floats floats;
    F most = hn::Mul(hn::Load(floats, b.weight), f(room.largestFactor));
    if constexpr (isUneven(kShape)) {
        const F least = hn::Sub(f(1), hn::Load(floats, b.change));
        most = hn::Div(most, hn::Sqrt(hn::Max(least, f(kLeastDenominator))));
    }
    if constexpr (kShape == Shape::Sphere) hn::Store(most, floats, b.weight);
    hn::Store(most, floats, b.mostDepth);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
