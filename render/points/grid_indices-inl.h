// Linear indices of points of the grid, one a lane. Compiled once for each of Highway's targets, so
// not guarded as other headers are.
#if defined(RENDER_GRID_INDICES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_GRID_INDICES_INL_H_
#undef RENDER_GRID_INDICES_INL_H_
#else
#define RENDER_GRID_INDICES_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using HalfInts = hn::Rebind<std::int32_t, Doubles>;
using Longs = hn::Rebind<std::int64_t, Doubles>;
using D = hn::Vec<Doubles>;

HWY_INLINE D d(double x) { return hn::Set(Doubles(), x); }

// Indices along the axes of linear ones: the quotients stand 1/2 / size away from any whole number,
// and doubles of indices below 2^32 keep that.
HWY_INLINE void alongAxes(const std::array<double, 3>& size, const std::uint32_t* index, D* at) {
    const HalfInts ints;
    constexpr std::int32_t kSign = std::numeric_limits<std::int32_t>::min();
    const auto low = hn::LoadU(ints, reinterpret_cast<const std::int32_t*>(index));
    const D i =
        hn::Add(hn::PromoteTo(Doubles(), hn::Xor(low, hn::Set(ints, kSign))), d(2147483648.0));
    const double slice = size[0] * size[1];
    at[2] = hn::Floor(hn::Mul(hn::Add(i, d(0.5)), d(1 / slice)));
    const D inSlice = hn::NegMulAdd(at[2], d(slice), i);
    at[1] = hn::Floor(hn::Mul(hn::Add(inSlice, d(0.5)), d(1 / size[0])));
    at[0] = hn::NegMulAdd(at[1], d(size[0]), inSlice);
}

// Their positions along axis a, of tables of all three.
HWY_INLINE void positionsOf(const std::array<const double*, 3>& position, const D* at, D* along) {
    for (std::size_t a = 0; a < 3; ++a) {
        const auto whole = hn::PromoteTo(Longs(), hn::DemoteTo(HalfInts(), at[a]));
        along[a] = hn::GatherIndex(Doubles(), position[a], whole);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
