#include "render/splat/slope_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/splat/slope_batch.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include "render/splat/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_ATTR void TakeSlopes(const SlopeBatch& batch, CellSlopes* to, SlopeBatch::Row& isNone) {
    static_assert(SlopeBatch::kMost % kLanes == 0);
    constexpr std::size_t kHalf = hn::MaxLanes(Doubles());
    for (std::size_t i = 0; i < batch.count; i += kLanes) {
        CellSlopes beside;  // for those that are not there
        CellSlopes* places[kLanes];
        for (std::size_t k = 0; k < kLanes; ++k)
            places[k] = i + k < batch.count ? to + i + k : &beside;
        D none[2] = {hn::Zero(Doubles()), hn::Zero(Doubles())};
        for (std::size_t a = 0; a < 3; ++a) {
            F slopes[8];
            for (std::size_t c = 0; c < 8; ++c) {
                D halves[2];
                for (std::size_t h = 0; h < 2; ++h) {
                    const auto load = [&](const SlopeBatch::Row& row) HWY_ATTR {
                        return hn::LoadU(Doubles(), row.data() + i + h * kHalf);
                    };
                    const D slope =
                        hn::Mul(load(batch.difference[a][c]), load(batch.scale[a][c >> a & 1]));
                    none[h] = hn::Add(none[h], hn::Sub(slope, slope));
                    halves[h] = hn::Min(hn::Max(slope, d(-kMostSlope)), d(kMostSlope));
                }
                slopes[c] = joined(halves);
            }
            toCoefficients(slopes);
            const F first[] = {slopes[0], slopes[1], slopes[2], slopes[4]};
            const F last[] = {slopes[3], slopes[5], slopes[6], slopes[7]};
            storeFours(first, [&](std::size_t k) { return (*places[k])[a].data(); });
            storeFours(last, [&](std::size_t k) { return (*places[k])[a].data() + 4; });
        }
        for (std::size_t h = 0; h < 2; ++h)
            hn::StoreU(none[h], Doubles(), isNone.data() + i + h * kHalf);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(TakeSlopes);

void SlopeBatch::take(CellSlopes* to, Row& isNone) const {
    HWY_DYNAMIC_DISPATCH(TakeSlopes)(*this, to, isNone);
}
}  // namespace render
#endif
