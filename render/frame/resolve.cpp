#include "render/frame/resolve.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/frame/resolve.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// (1 - e^-t) / t, 1 at 0.
template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE V meanTransmission(Lanes lanes, V t) {
    const auto set = [&](float c) HWY_ATTR { return hn::Set(lanes, c); };
    const V least = set(0.1f), large = hn::Max(t, least);
    V series = hn::NegMulAdd(t, set(1.0f / 720), set(1.0f / 120));
    series = hn::NegMulAdd(t, series, set(1.0f / 24));
    series = hn::NegMulAdd(t, series, set(1.0f / 6));
    series = hn::NegMulAdd(t, series, set(0.5f));
    series = hn::NegMulAdd(t, series, set(1));
    const V taken = hn::Neg(hn::Expm1(lanes, hn::Neg(hn::Min(large, set(80)))));
    return hn::IfThenElse(hn::Gt(t, least), hn::Div(taken, large), series);
}

// Premultiplied colour and opacity of a vector of pixels; false where all of it is nothing.
template <class Lanes, class V = hn::Vec<Lanes>>
HWY_INLINE bool resolved(Lanes lanes, std::span<const SummedRow> planes, std::size_t at,
                         V (&c)[4]) {
    if (planes.size() == 1 && planes[0].channels == Channels::Over) {
        hn::LoadInterleaved4(lanes, planes[0].sums + 4 * at, c[0], c[1], c[2], c[3]);
        return true;
    }
    for (V& channel : c) channel = hn::Zero(lanes);
    for (const SummedRow& plane : planes) {
        const V perWeight = hn::Set(lanes, plane.perWeight);
        V sum[4];
        if (plane.channels == Channels::Weight) {
            sum[3] = hn::LoadU(lanes, plane.sums + at);
            for (std::size_t k = 0; k < 3; ++k)
                sum[k] = hn::Mul(sum[3], hn::Set(lanes, plane.rgb[k]));
        } else {
            hn::LoadInterleaved4(lanes, plane.sums + 4 * at, sum[0], sum[1], sum[2], sum[3]);
        }
        for (std::size_t k = 0; k < 4; ++k) c[k] = hn::MulAdd(perWeight, sum[k], c[k]);
    }
    if (hn::AllFalse(lanes, hn::Gt(c[3], hn::Zero(lanes)))) return false;
    const V mean = meanTransmission(lanes, c[3]);
    for (V& channel : c) channel = hn::Mul(mean, channel);
    return true;
}

template <class Lanes>
HWY_INLINE void blend(Lanes lanes, std::span<const SummedRow> planes, std::size_t at,
                      float* light) {
    hn::Vec<Lanes> c[4], under[4];
    if (!resolved(lanes, planes, at, c)) return;
    float* const to = light + 4 * at;
    hn::LoadInterleaved4(lanes, to, under[0], under[1], under[2], under[3]);
    const auto rest = hn::Sub(hn::Set(lanes, 1.0f), c[3]);
    for (std::size_t k = 0; k < 4; ++k) c[k] = hn::MulAdd(rest, under[k], c[k]);
    hn::StoreInterleaved4(c[0], c[1], c[2], c[3], lanes, to);
}

HWY_ATTR void ResolveRow(std::span<const SummedRow> planes, std::size_t pixels, float* light) {
    const hn::ScalableTag<float> lanes;
    const std::size_t step = hn::Lanes(lanes);
    std::size_t at = 0;
    for (; at + step <= pixels; at += step) blend(lanes, planes, at, light);
    for (; at < pixels; ++at) blend(hn::CappedTag<float, 1>(), planes, at, light);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {

HWY_EXPORT(ResolveRow);

void resolveRow(std::span<const SummedRow> planes, std::size_t pixels, float* light) {
    HWY_DYNAMIC_DISPATCH(ResolveRow)(planes, pixels, light);
}

}  // namespace render
#endif
