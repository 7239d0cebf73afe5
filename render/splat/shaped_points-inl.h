// Points as a mesh keeps them, one a lane: timeseries/grid/shaped_point.h. Compiled once for each
// of Highway's targets, so not guarded as other headers are.
#if defined(RENDER_SPLAT_SHAPED_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SPLAT_SHAPED_POINTS_INL_H_
#undef RENDER_SPLAT_SHAPED_POINTS_INL_H_
#else
#define RENDER_SPLAT_SHAPED_POINTS_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "timeseries/grid/shaped_point.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Of as many as there are lanes, each of their words in a vector.
template <class Words>
HWY_INLINE void loadWords(Words words, const timeseries::ShapedPoint* points,
                          hn::Vec<Words>* word) {
    static_assert(hn::MaxLanes(Words()) > 1);
    const std::uint32_t* const from = points->word.data();
    hn::Vec<Words> first[3], last[3];  // halves of points, of the first half of them and the others
    hn::LoadInterleaved3(words, from, first[0], first[1], first[2]);
    hn::LoadInterleaved3(words, from + 3 * hn::Lanes(words), last[0], last[1], last[2]);
    for (std::size_t i = 0; i < 3; ++i) {
        word[i] = hn::ConcatEven(words, last[i], first[i]);
        word[3 + i] = hn::ConcatOdd(words, last[i], first[i]);
    }
}

// SmallFloat::magnitude of the last bits, what stands before them left out.
template <const timeseries::SmallFloat& kForm, class Words>
HWY_INLINE auto magnitudesOf(Words words, hn::Vec<Words> bits) {
    const hn::Rebind<float, Words> floats;
    const hn::Rebind<std::int32_t, Words> ints;
    const auto code = hn::And(bits, hn::Set(words, kForm.last()));
    const auto high = hn::Add(hn::ShiftLeft<23 - kForm.mantissa>(code),
                              hn::Set(words, static_cast<std::uint32_t>(126 + kForm.least) << 23));
    const auto low = hn::Mul(hn::ConvertTo(floats, hn::BitCast(ints, code)),
                             hn::Set(floats, kForm.magnitude(1)));
    const auto isLow = hn::Lt(code, hn::Set(words, std::uint32_t{1} << kForm.mantissa));
    return hn::IfThenElse(hn::RebindMask(floats, isLow), low, hn::BitCast(floats, high));
}
// With the sign before them.
template <const timeseries::SmallFloat& kForm, class Words>
HWY_INLINE auto signedOf(Words words, hn::Vec<Words> bits) {
    const auto sign = hn::And(hn::ShiftLeft<31 - kForm.bits>(bits), hn::Set(words, 1u << 31));
    const auto magnitude = magnitudesOf<kForm>(words, bits);
    return hn::Or(magnitude, hn::BitCast(hn::Rebind<float, Words>(), sign));
}

// A coordinate of ShapedPoint::at(), but for points that have no place.
template <class Words>
HWY_INLINE auto placesOf(Words words, hn::Vec<Words> word) {
    return signedOf<timeseries::ShapedPoint::kPlace>(words, word);
}

// ShapedPoint::cell() and widened().
template <class Words>
struct ShapedCells {
    using Floats = hn::Rebind<float, Words>;
    hn::Vec<Floats> diagonal[3], below[3], share;  // 2^-widened
    hn::Mask<Floats> turned;
};
template <class Words>
HWY_INLINE ShapedCells<Words> cellsOf(Words words, const hn::Vec<Words>* word) {
    using Point = timeseries::ShapedPoint;
    constexpr int kPlace = Point::kPlaceBits, kSide = Point::kSide.bits;
    constexpr int kRight = Point::kRightSide.bits;
    const hn::Rebind<float, Words> floats;
    ShapedCells<Words> cells;
    cells.diagonal[0] = magnitudesOf<Point::kSide>(words, word[3]);
    cells.diagonal[1] = magnitudesOf<Point::kRightSide>(words, word[4]);
    cells.diagonal[2] = magnitudesOf<Point::kSide>(words, hn::ShiftRight<kSide>(word[3]));
    const auto first = hn::Or(hn::ShiftRight<kPlace>(word[0]),
                              hn::Or(hn::ShiftLeft<5>(hn::ShiftRight<kPlace>(word[1])),
                                     hn::ShiftLeft<10>(hn::ShiftRight<kPlace>(word[2]))));
    cells.below[0] = hn::Mul(cells.diagonal[1], signedOf<Point::kFirstSlope>(words, first));
    cells.below[1] = hn::Mul(cells.diagonal[2], signedOf<Point::kSlope>(words, word[5]));
    cells.below[2] =
        hn::Mul(cells.diagonal[2], signedOf<Point::kSlope>(words, hn::ShiftRight<16>(word[5])));
    const auto widened =
        hn::Or(hn::ShiftRight<31>(word[3]), hn::ShiftLeft<1>(hn::ShiftRight<kRight>(word[4])));
    cells.share = hn::BitCast(floats, hn::ShiftLeft<23>(hn::Sub(hn::Set(words, 127), widened)));
    const auto turn = hn::And(word[3], hn::Set(words, 1u << 30));
    cells.turned = hn::RebindMask(floats, hn::Ne(turn, hn::Zero(words)));
    return cells;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
