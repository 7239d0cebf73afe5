// Vectors of floats and what is computed with them, for splats and cells. Compiled once for each of
// Highway's targets, so not guarded as other headers are.
#if defined(RENDER_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_LANES_INL_H_
#undef RENDER_LANES_INL_H_
#else
#define RENDER_LANES_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "render/points/grid_indices-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Of splats, one a lane, and of the pixels of a row; doubles and their indices half as many.
using Floats = hn::CappedTag<float, 16>;
using Ints = hn::Rebind<std::int32_t, Floats>;
using FewFloats = hn::CappedTag<float, 8>;  // pixels of narrow splats
constexpr std::size_t kLanes = hn::MaxLanes(Floats());
using F = hn::Vec<Floats>;
using I = hn::Vec<Ints>;

using HalfFloats = hn::Rebind<float, Doubles>;
HWY_INLINE F joined(D low, D high) {
    return hn::Combine(Floats(), hn::DemoteTo(HalfFloats(), high), hn::DemoteTo(HalfFloats(), low));
}
HWY_INLINE F joined(const D* halves) { return joined(halves[0], halves[1]); }
HWY_INLINE I joinedInts(D low, D high) {
    return hn::Combine(Ints(), hn::DemoteTo(HalfInts(), high), hn::DemoteTo(HalfInts(), low));
}

HWY_INLINE F f(float x) { return hn::Set(Floats(), x); }

// Of three vectors each, of floats or of doubles.
template <class V>
HWY_INLINE V dot(const V* a, const V* b) {
    return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
}
template <class V>
HWY_INLINE void cross(const V* a, const V* b, V* product) {
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        product[k] = hn::NegMulAdd(a[j], b[i], hn::Mul(a[i], b[j]));
    }
}

// As cell::coefficients(), but each where its corner was.
template <class V>
HWY_INLINE void toCoefficients(V* corners) {
    const hn::DFromV<V> lanes;
    for (const std::size_t step : {1u, 2u, 4u})
        for (std::size_t i = 0; i < 8; ++i)
            if ((i & step) == 0) {
                const V a = corners[i], b = corners[i + step];
                corners[i] = hn::Mul(hn::Set(lanes, 0.5f), hn::Add(a, b));
                corners[i + step] = hn::Sub(b, a);
            }
}

// Four floats of each lane, as they lie in records of it: row(k) is where lane k's do.
template <class Lanes, class Row>
HWY_INLINE hn::Vec<Lanes> everyFourth(Lanes lanes, std::size_t first, const Row& row) {
    if constexpr (hn::MaxLanes(Lanes()) == 4) {
        return hn::LoadU(lanes, row(first));
    } else {
        const hn::Half<Lanes> half;
        return hn::Combine(lanes, everyFourth(half, first + hn::MaxLanes(Lanes()) / 2, row),
                           everyFourth(half, first, row));
    }
}
template <class Lanes, class Row>
HWY_INLINE void putEveryFourth(Lanes lanes, hn::Vec<Lanes> v, std::size_t first, const Row& row) {
    if constexpr (hn::MaxLanes(Lanes()) == 4) {
        hn::StoreU(v, lanes, row(first));
    } else {
        const hn::Half<Lanes> half;
        putEveryFourth(half, hn::LowerHalf(half, v), first, row);
        putEveryFourth(half, hn::UpperHalf(half, v), first + hn::MaxLanes(Lanes()) / 2, row);
    }
}
// In each block of four lanes: rows become columns.
HWY_INLINE void transpose(F* v) {
    const Floats floats;
    const hn::Repartition<std::uint64_t, Floats> pairs;
    const auto pair = [&](F x) HWY_ATTR { return hn::BitCast(pairs, x); };
    const auto low01 = pair(hn::InterleaveLower(floats, v[0], v[1]));
    const auto low23 = pair(hn::InterleaveLower(floats, v[2], v[3]));
    const auto high01 = pair(hn::InterleaveUpper(floats, v[0], v[1]));
    const auto high23 = pair(hn::InterleaveUpper(floats, v[2], v[3]));
    v[0] = hn::BitCast(floats, hn::InterleaveLower(pairs, low01, low23));
    v[1] = hn::BitCast(floats, hn::InterleaveUpper(pairs, low01, low23));
    v[2] = hn::BitCast(floats, hn::InterleaveLower(pairs, high01, high23));
    v[3] = hn::BitCast(floats, hn::InterleaveUpper(pairs, high01, high23));
}
template <class Row>
HWY_INLINE void loadFours(const Row& row, F* v) {
    for (std::size_t r = 0; r < 4; ++r) v[r] = everyFourth(Floats(), r, row);
    transpose(v);
}
template <class Row>
HWY_INLINE void storeFours(const F* v, const Row& row) {
    F rows[4] = {v[0], v[1], v[2], v[3]};
    transpose(rows);
    for (std::size_t r = 0; r < 4; ++r) putEveryFourth(Floats(), rows[r], r, row);
}

// AVX3's first guess has 14 bits, others' 8 or 12.
template <class Lanes>
HWY_INLINE hn::Vec<Lanes> reciprocal(Lanes lanes, hn::Vec<Lanes> x) {
    const auto two = hn::Set(lanes, 2.0f);
    auto r = hn::ApproximateReciprocal(x);
    r = hn::Mul(r, hn::NegMulAdd(x, r, two));
    if (HWY_TARGET != HWY_AVX3) r = hn::Mul(r, hn::NegMulAdd(x, r, two));
    return r;
}
template <class Lanes>
HWY_INLINE hn::Vec<Lanes> reciprocalRoot(Lanes lanes, hn::Vec<Lanes> x) {
    const auto half = hn::Mul(x, hn::Set(lanes, 0.5f)), most = hn::Set(lanes, 1.5f);
    auto r = hn::ApproximateReciprocalSqrt(x);
    r = hn::Mul(r, hn::NegMulAdd(hn::Mul(half, r), r, most));
    if (HWY_TARGET != HWY_AVX3) r = hn::Mul(r, hn::NegMulAdd(hn::Mul(half, r), r, most));
    return r;
}

// 1 - e^-x. Small: of x in [0, 1/2], by Chebyshev's interpolation of (1 - e^-x) / x, to 1.5e-9.
template <bool kSmall, class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE V opacity(Lanes lanes, V x) {
    const auto set = [&](double c) HWY_ATTR { return hn::Set(lanes, static_cast<float>(c)); };
    if constexpr (kSmall) {
        V p = hn::MulAdd(x, set(-0.0011234042190441439), set(0.008189613631091872));
        p = hn::MulAdd(p, x, set(-0.041630072831850246));
        p = hn::MulAdd(p, x, set(0.16666241868658546));
        p = hn::MulAdd(p, x, set(-0.4999998187742346));
        return hn::Mul(x, hn::MulAdd(p, x, set(0.999999998742602)));
    }
    return hn::Neg(hn::Expm1(lanes, hn::Neg(hn::Min(x, set(80)))));
}

// Neighbouring pixels of one row, whose floats lie one after another.
template <class Lanes>
struct PixelRow {
    using V = hn::Vec<Lanes>;
    HWY_INLINE V load(Lanes lanes, const float* from) const { return hn::LoadU(lanes, from); }
    HWY_INLINE void store(Lanes lanes, V v, float* to) const { hn::StoreU(v, lanes, to); }
};

// Neighbouring pixels of as many rows as make a vector of four columns, in rows so many floats
// apart.
template <class Lanes, std::size_t kStride>
struct PixelBlock {
    using V = hn::Vec<Lanes>;
    static constexpr std::size_t kColumns = std::min(hn::MaxLanes(Lanes()), std::size_t{4});
    static constexpr std::size_t kRows = hn::MaxLanes(Lanes()) / kColumns;
    HWY_INLINE V load(Lanes lanes, const float* from) const {
        if constexpr (kRows == 1) {
            return hn::LoadU(lanes, from);
        } else {
            const hn::Half<Lanes> half;
            const PixelBlock<hn::Half<Lanes>, kStride> rows;
            return hn::Combine(lanes, rows.load(half, from + kRows / 2 * kStride),
                               rows.load(half, from));
        }
    }
    HWY_INLINE void store(Lanes lanes, V v, float* to) const {
        if constexpr (kRows == 1) {
            hn::StoreU(v, lanes, to);
        } else {
            const hn::Half<Lanes> half;
            const PixelBlock<hn::Half<Lanes>, kStride> rows;
            rows.store(half, hn::LowerHalf(half, v), to);
            rows.store(half, hn::UpperHalf(half, v), to + kRows / 2 * kStride);
        }
    }
    // Of each pixel, from the first.
    static HWY_INLINE V columns(Lanes lanes) {
        return hn::ConvertTo(lanes, hn::And(hn::Iota(Int(), 0), hn::Set(Int(), kColumns - 1)));
    }
    static HWY_INLINE V rows(Lanes lanes) {
        return hn::Mul(hn::Sub(hn::Iota(lanes, 0), columns(lanes)),
                       hn::Set(lanes, 1.0f / kColumns));
    }

 private:
    using Int = hn::RebindToSigned<Lanes>;
};

// Front to back: of what comes through, a layer of optical depth x takes its share, and what it has
// of each colour is added to what stands at `sums` and `plane` floats on. Where less than a 10^7th
// comes through, nothing does any more. The sum is of what is taken, not what is left of 1, which
// would lose the faintest.
template <bool kSmall, class Pixels, class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE void layUnder(Pixels pixels, Lanes lanes, V x, const V* color, float* sums,
                         std::size_t plane) {
    float* const all = sums + 3 * plane;
    const auto one = hn::Set(lanes, 1.0f), before = pixels.load(lanes, all);
    const auto taken = hn::Mul(hn::Sub(one, before), opacity<kSmall>(lanes, x));
    for (std::size_t c = 0; c < 3; ++c) {
        float* const to = sums + c * plane;
        pixels.store(lanes, hn::MulAdd(taken, color[c], pixels.load(lanes, to)), to);
    }
    const auto now = hn::Add(before, taken);
    pixels.store(lanes, hn::IfThenElse(hn::Lt(now, hn::Set(lanes, 1 - 1e-7f)), now, one), all);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
