// What of the values in a cell or a tetrahedron lies in its range, which colours and light that
// has, and what it adds to a tile. Compiled once for each of Highway's targets, so not guarded as
// other headers are.
#if defined(RENDER_CELL_RANGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_CELL_RANGE_INL_H_
#undef RENDER_CELL_RANGE_INL_H_
#else
#define RENDER_CELL_RANGE_INL_H_
#endif

#include <hwy/cache_control.h>

#include <algorithm>

#include "render/splat/cell_view.h"
#include "render/splat/lanes-inl.h"
#include "render/splat/tile_room.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Of a list of cells or tetrahedra, those of one tile lie all over it.
constexpr std::size_t kAhead = 20;
template <class Piece>
HWY_INLINE void prefetch(const Piece& piece) {
    const auto* bytes = reinterpret_cast<const char*>(&piece);
    for (std::size_t at = 0; at < sizeof piece; at += 64) hwy::Prefetch(bytes + at);
}

// How much of a piece of a ray lies in a cell's range, of which it crosses so many ends, and what
// values are there.
template <class Lanes, int kEnds>
struct RangeLanes {
    using V = hn::Vec<Lanes>;
    Lanes lanes;
    V end[kEnds], least, most;
    // What is between these ends is sign * the range + offset.
    V sign, offset;
    RangeLanes(Lanes l, const SeenPiece& c) : lanes(l) {
        const bool first = c.crossesLeast();
        end[0] = hn::Set(l, first ? c.least : c.most);
        if constexpr (kEnds == 2) end[1] = hn::Set(l, c.most);
        sign = hn::Set(l, first ? 1.0f : -1.0f);
        offset = hn::Set(l, first ? 0.0f : 1.0f);
        least = hn::Set(l, first ? std::max(c.least, -1.0f) : -1.0f);
        most = hn::Set(l, c.crossesMost() ? std::min(c.most, 1.0f) : 1.0f);
    }
    HWY_INLINE V within(V value) const { return hn::Min(hn::Max(value, least), most); }
    // The ends of the values in the range that a pixel sees of a piece.
    HWY_INLINE void ends(V first, V last, V width, V& low, V& high) const {
        const V reach = hn::Mul(hn::Set(lanes, 0.5f), width);
        low = within(hn::Sub(hn::Min(first, last), reach));
        high = within(hn::Add(hn::Max(first, last), reach));
    }

    // Of a value, the integral of its share in the range from where that begins, times the width of
    // the ramps at the range's ends, and that share times the width; and, where values are asked
    // for, the integral of what the values in the range are above its first end, likewise, and what
    // that integral grows by. `before` is where ramps begin.
    struct Passed {
        V way, share, above, aboveNow;
    };
    template <bool kValues = false>
    HWY_INLINE Passed passed(V value, const V* before, V width) const {
        const V half = hn::Set(lanes, 0.5f), zero = hn::Zero(lanes);
        const auto ofRamp = [&](V from) HWY_ATTR {
            const V x = hn::Sub(value, from);
            const V on = hn::Min(hn::Max(x, zero), width);
            Passed is{hn::Mul(on, hn::NegMulAdd(half, on, x)), on, zero, zero};
            if constexpr (kValues) {
                const V past = hn::Max(hn::Sub(x, width), zero);  // on is the width then
                const V inside = hn::Mul(hn::Mul(on, on), hn::Set(lanes, 1 / 6.0f));
                is.above =
                    hn::Mul(on, hn::MulAdd(hn::Mul(half, past), hn::Add(width, past), inside));
            }
            return is;
        };
        Passed is = ofRamp(before[0]);
        if constexpr (kEnds == 2) {
            const Passed beyond = ofRamp(before[1]);
            is.way = hn::Sub(is.way, beyond.way);
            is.share = hn::Sub(is.share, beyond.share);
            if constexpr (kValues) {
                const V range = hn::Sub(end[1], end[0]);
                is.above = hn::Sub(is.above, hn::MulAdd(range, beyond.way, beyond.above));
                is.aboveNow = hn::NegMulAdd(range, beyond.share, is.way);
            }
        } else {
            is.aboveNow = is.way;
        }
        return is;
    }
    HWY_INLINE void ramps(V width, V* before) const {
        for (std::size_t k = 0; k < kEnds; ++k)
            before[k] = hn::NegMulAdd(hn::Set(lanes, 0.5f), width, end[k]);
    }

    // Of a piece between two values, which differ so much: its share in the range; and what its
    // values there are above the first end, times that share.
    struct Share {
        V is, above;
    };
    template <bool kValues = false>
    HWY_INLINE Share share(V begins, V ends, const Passed& first, const Passed& last,
                           V perWidth) const {
        const V one = hn::Set(lanes, 1.0f), half = hn::Set(lanes, 0.5f);
        const V change = hn::Sub(ends, begins);
        const auto differ =
            hn::Ge(hn::Abs(change), hn::Set(lanes, static_cast<float>(kLeastDifference)));
        const V per = hn::Mul(reciprocal(lanes, hn::IfThenElse(differ, change, one)), perWidth);
        const auto mean = [&](V a, V b, V aNow, V bNow) HWY_ATTR {
            const V sum = hn::IfThenElse(differ, hn::Sub(b, a), hn::Mul(half, hn::Add(aNow, bNow)));
            return hn::Mul(sum, per);
        };
        Share share{hn::MulAdd(sign, mean(first.way, last.way, first.share, last.share), offset),
                    hn::Zero(lanes)};
        if constexpr (kValues) {
            const V middle = hn::MulSub(half, hn::Add(begins, ends), end[0]);
            share.above =
                hn::MulAdd(sign, mean(first.above, last.above, first.aboveNow, last.aboveNow),
                           hn::Mul(offset, middle));
        }
        return share;
    }
    // The mean of values in the range that are so much above its first end, times `share`.
    HWY_INLINE V meanValue(V above, V share, V perWidth) const {
        const V some = hn::Max(share, hn::Set(lanes, 1e-30f));
        V mean = hn::MulAdd(above, reciprocal(lanes, some), end[0]);
        if constexpr (kEnds == 2) {
            const V half = hn::Set(lanes, 0.5f), range = hn::Sub(end[1], end[0]);
            const V twice = hn::Mul(hn::Add(range, range), perWidth);  // as cell::seenApart()
            const V apart =
                hn::Min(hn::Max(hn::Sub(twice, half), hn::Zero(lanes)), hn::Set(lanes, 1.0f));
            const V middle = hn::MulAdd(half, range, end[0]);
            mean = hn::MulAdd(apart, hn::Sub(mean, middle), middle);
        }
        return within(mean);
    }

    // What the pieces between these values weigh, of a way that weighs so much, or `perChange` for
    // what it changes, if that is more; of the values in the range the weighted mean and the ends.
    template <bool kByValue>
    HWY_INLINE V sum(const V* values, V width, V perWidth, V way, const V* perChange, V& mean,
                     V& lowest, V& highest) const {
        const V zero = hn::Zero(lanes);
        const V length = hn::Mul(way, hn::Set(lanes, 1.0f / kPieces));
        V weight = zero, above = zero, before[kEnds];
        ramps(width, before);
        lowest = hn::Set(lanes, 2.0f);  // more than f can be
        highest = hn::Neg(lowest);
        Passed at = passed<kByValue>(values[0], before, width);
        for (std::size_t k = 0; k < kPieces; ++k) {
            const V first = values[k], last = values[k + 1];
            const Passed next = passed<kByValue>(last, before, width);
            V whole = length;
            if (perChange)
                whole = hn::Max(length, hn::Mul(*perChange, hn::Abs(hn::Sub(last, first))));
            const Share of = share<kByValue>(first, last, at, next, perWidth);
            const V is = hn::Mul(of.is, whole);
            at = next;
            weight = hn::Add(weight, is);
            if constexpr (kByValue) {
                above = hn::MulAdd(of.above, whole, above);
                V low, high;
                ends(first, last, width, low, high);
                const auto counts = hn::Gt(is, zero);
                lowest = hn::IfThenElse(counts, hn::Min(lowest, low), lowest);
                highest = hn::IfThenElse(counts, hn::Max(highest, high), highest);
            }
        }
        if constexpr (kByValue) mean = meanValue(above, weight, perWidth);
        return hn::Max(weight, zero);
    }
};

// Linear colours of a vector of values: of a layer's map, or one for all.
template <bool kByValue, class Lanes>
struct ColorLanes {
    using V = hn::Vec<Lanes>;
    Lanes lanes;
    const float *table, *sums;
    V place, perValue, first, last, lastWhole;
    V color[3];
    float weight;
    ColorLanes(Lanes l, const CellView& view, const SeenPiece& c)
        : lanes(l),
          table(view.tints[0].data()),
          sums(view.tintSums[0].data()),
          place(hn::Set(l, c.tint)),
          perValue(hn::Set(l, c.tintPerValue)),
          first(hn::Set(l, c.firstTint)),
          last(hn::Set(l, c.lastTint)),
          lastWhole(hn::Set(l, c.lastTint - 1)),
          weight(view.tints[static_cast<std::size_t>(c.firstTint)][3]) {
        const auto& one = view.tints[static_cast<std::size_t>(c.firstTint)];
        for (std::size_t k = 0; k < 3; ++k) color[k] = hn::Set(l, one[k]);
    }
    // The mean of the colours of all values between these.
    HWY_INLINE void between(V a, V b, V* is) const {
        if constexpr (!kByValue) {
            std::copy_n(color, 3, is);
        } else {
            const V from = placeOf(a), to = placeOf(b), way = hn::Sub(to, from);
            const V half = hn::Set(lanes, 0.5f), one = hn::Set(lanes, 1.0f);
            const auto isFar = hn::Gt(hn::Abs(way), hn::Set(lanes, 2.0f));
            if (!hn::AllTrue(lanes, isFar)) entry(table, hn::Mul(half, hn::Add(from, to)), is);
            if (hn::AllFalse(lanes, isFar)) return;
            const V per = reciprocal(lanes, hn::IfThenElse(isFar, way, one));
            if (hn::AllTrue(lanes, isFar)) std::fill_n(is, 3, one);
            V sumFrom[3], sumTo[3];
            entry(sums, from, sumFrom);
            entry(sums, to, sumTo);
            for (int k = 0; k < 3; ++k)
                is[k] = hn::IfThenElse(isFar, hn::Mul(per, hn::Sub(sumTo[k], sumFrom[k])), is[k]);
        }
    }

 private:
    HWY_INLINE V placeOf(V value) const {
        return hn::Min(hn::Max(hn::MulAdd(value, perValue, place), first), last);
    }
    // Entries are read whole, four lanes' by four, and their colours put beside each other: to
    // gather number by number takes a frame by value 1.4 times as long with AVX2.
    HWY_INLINE void entry(const float* of, V at, V* is) const {
        const V below = hn::Min(hn::Floor(at), lastWhole), share = hn::Sub(at, below);
        constexpr hn::RebindToSigned<Lanes> whole;
        alignas(64) std::int32_t where[hn::MaxLanes(Lanes())];
        hn::Store(hn::ShiftLeft<2>(hn::ConvertTo(whole, below)), whole, where);
        const V a = between<0>(of, where, share), b = between<1>(of, where, share);
        const V c = between<2>(of, where, share), d = between<3>(of, where, share);
        const hn::RepartitionToWide<hn::RebindToUnsigned<Lanes>> pairs;
        const auto two = [&](V v) HWY_ATTR { return hn::BitCast(pairs, v); };
        const auto ab = two(hn::InterleaveLower(lanes, a, b));
        const auto cd = two(hn::InterleaveLower(lanes, c, d));
        const auto blues = hn::InterleaveLower(pairs, two(hn::InterleaveUpper(lanes, a, b)),
                                               two(hn::InterleaveUpper(lanes, c, d)));
        is[0] = hn::BitCast(lanes, hn::InterleaveLower(pairs, ab, cd));
        is[1] = hn::BitCast(lanes, hn::InterleaveUpper(pairs, ab, cd));
        is[2] = hn::BitCast(lanes, blues);
    }
    // Of each four lanes the k-th one's colour and weight, between two entries.
    template <int k>
    HWY_INLINE V between(const float* of, const std::int32_t* where, V share) const {
        const V low = entries(lanes, of, where + k), high = entries(lanes, of + 4, where + k);
        return hn::MulAdd(hn::Broadcast<k>(share), hn::Sub(high, low), low);
    }
    // Of every fourth lane.
    template <class Part>
    static HWY_INLINE hn::Vec<Part> entries(Part part, const float* of, const std::int32_t* where) {
        if constexpr (hn::MaxLanes(part) == 4) {
            return hn::LoadU(part, of + *where);
        } else {
            const hn::Half<Part> half;
            return hn::Combine(part, entries(half, of, where + hn::MaxLanes(half)),
                               entries(half, of, where));
        }
    }
};

template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE V shareFromFront(Lanes lanes, V x) {
    const V twelfth = hn::Set(lanes, 1 / 12.0f), half = hn::Set(lanes, 0.5f);
    const V below = hn::MulAdd(x, hn::MulAdd(x, twelfth, half), hn::Set(lanes, 2.0f));
    return hn::Mul(hn::MulAdd(x, twelfth, hn::Set(lanes, 1.0f)), reciprocal(lanes, below));
}

// Of the values that a pixel sees of a layer, from its front to its back, how far back they are
// seen: twice as far as the light comes from in the mean. The whole way through a cell, on which
// values change by `along`, has this optical depth, and so much of it as leads through those values
// hides what is behind: also where the layer goes on in the next cell, and less lies in this one,
// x. Of more values than its ray meets, a pixel sees the others beside it, where they hide nothing.
template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE V seenTo(Lanes lanes, V front, V back, V x, V whole, V along) {
    const V one = hn::Set(lanes, 1.0f), tiny = hn::Set(lanes, 1e-30f);
    const V seen = hn::Sub(back, front);
    const V values = hn::Max(hn::Abs(seen), tiny), met = hn::Max(hn::Abs(along), tiny);
    const V hiding = hn::Min(hn::Mul(met, reciprocal(lanes, values)), one);
    const V through = hn::Mul(whole, hn::Min(hn::Mul(values, reciprocal(lanes, met)), one));
    const V share = shareFromFront(lanes, hn::Max(x, through));
    return hn::MulAdd(hn::MulAdd(hiding, hn::Sub(hn::Add(share, share), one), one), seen, front);
}

// Of a surface, as far as there is one, whose normal has so much of the ways to the lamp and
// halfway from there to the eye.
template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE void lightOf(Lanes lanes, Light light, V certainty, V facing, V half, V& diffuse,
                        V& specular) {
    const V ambient = hn::Set(lanes, static_cast<float>(kAmbient));
    const V rest = hn::Set(lanes, static_cast<float>(1 - kAmbient));
    const V even = hn::Set(lanes, static_cast<float>(kEven));
    diffuse = hn::MulAdd(certainty, hn::Sub(hn::MulAdd(rest, facing, ambient), even), even);
    specular = hn::Zero(lanes);
    if (light == Light::Soft) return;
    const V f2 = hn::Mul(half, half), f4 = hn::Mul(f2, f2), f8 = hn::Mul(f4, f4);
    const V f30 = hn::Mul(hn::Mul(hn::Mul(f8, f8), f8), hn::Mul(f4, f2));
    specular = hn::Mul(hn::Mul(certainty, hn::Set(lanes, static_cast<float>(kSpecular))), f30);
}
// Of a lamp in the world: the gradient's direction has so much of the way to it, faces the eye so
// much, and changes so along the ray, whose own direction has so much of that way.
template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE void lampLightOf(Lanes lanes, Light light, V certainty, V ofGradient, V facing, V change,
                            V ofRay, V& diffuse, V& specular) {
    const V zero = hn::Zero(lanes), one = hn::Set(lanes, 1.0f);
    // The normal on the eye's side is that in which the field falls along the ray.
    const V onSide = hn::IfThenElse(hn::Gt(change, zero), hn::Neg(ofGradient), ofGradient);
    const V towards = hn::Min(hn::Max(onSide, zero), one);
    V half = zero;
    if (light == Light::Full) {
        const V between2 = hn::Sub(hn::Set(lanes, 2.0f), hn::Add(ofRay, ofRay));
        const V per = reciprocalRoot(lanes, hn::Max(between2, hn::Set(lanes, 1e-12f)));
        half = hn::Min(hn::Max(hn::Mul(hn::Add(onSide, facing), per), zero), one);
    }
    lightOf(lanes, light, certainty, towards, half, diffuse, specular);
    const V low = hn::Min(hn::Mul(towards, hn::Set(lanes, static_cast<float>(1 / kLow))), one);
    specular = hn::Mul(specular, low);
}

// Adds weights W of pixels that begin at `at`, of the colours that paint(colors) tells.
template <Channels kChannels, class Pixels, class Lanes, class V, class Paint>
HWY_INLINE void addWeight(Pixels pixels, Lanes lanes, V t, TileRoom& room, std::size_t at,
                          const Paint& paint) {
    float* const sums = room.sums.data() + at;
    if constexpr (kChannels == Channels::Weight) {
        pixels.store(lanes, hn::Add(t, pixels.load(lanes, sums)), sums);
    } else if constexpr (kChannels == Channels::Count) {
        const V counted = hn::IfThenElseZero(hn::Gt(t, hn::Zero(lanes)), hn::Set(lanes, 1.0f));
        pixels.store(lanes, hn::Add(counted, pixels.load(lanes, sums)), sums);
    } else {
        V colors[3];
        paint(colors);
        if constexpr (kChannels == Channels::WeightedColor) {
            for (std::size_t k = 0; k < 4; ++k) {
                float* const sum = sums + k * room.plane;
                const V share = k < 3 ? hn::Mul(t, colors[k]) : t;
                pixels.store(lanes, hn::Add(share, pixels.load(lanes, sum)), sum);
            }
        } else {
            const V factor = pixels.load(lanes, room.factor.data() + at);
            layUnder<false>(pixels, lanes, hn::Mul(t, factor), colors, sums, room.plane);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
