#include "timeseries/index/values_within.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "timeseries/index/values_within.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace timeseries {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <typename V>
HWY_INLINE auto isWithin(V value, V least, V most) {
    if constexpr (hwy::IsFloat<hn::TFromV<V>>())
        return hn::And(hn::Ge(value, least), hn::Le(value, most));  // no NaN is
    else
        return hn::Not(hn::Or(hn::Lt(value, least), hn::Gt(value, most)));
}

template <typename T>
HWY_INLINE std::size_t within(const T* HWY_RESTRICT values, std::size_t count, T lo, T hi,
                              OrderedKey<T>* HWY_RESTRICT places) {
    const hn::ScalableTag<T> d;
    const hn::ScalableTag<OrderedKey<T>> of;
    const std::size_t lanes = hn::Lanes(d);
    const auto least = hn::Set(d, lo), most = hn::Set(d, hi);
    std::size_t found = 0, i = 0;
    for (; i + lanes <= count; i += lanes) {
        const auto value = hn::LoadU(d, values + i);
        const auto isIn = isWithin(value, least, most);
        const auto place = hn::Iota(of, static_cast<OrderedKey<T>>(i));
        // In a register first: written by halves of a vector it takes ten times as long (Zen 4).
        hn::StoreU(hn::Compress(place, hn::RebindMask(of, isIn)), of, places + found);
        found += hn::CountTrue(d, isIn);
    }
    for (; i < count; ++i) {
        places[found] = static_cast<OrderedKey<T>>(i);
        found += static_cast<std::size_t>(lo <= values[i] && values[i] <= hi);
    }
    return found;
}

// Of one type each: these are what a table of targets can hold.
#define ISOCHRON_WITHIN(T, name)                                                              \
    std::size_t within##name(const T* values, std::size_t count, const Interval<T>& interval, \
                             OrderedKey<T>* places) {                                         \
        return within(values, count, interval.lo, interval.hi, places);                       \
    }
ISOCHRON_WIDE_TYPES(ISOCHRON_WITHIN)
#undef ISOCHRON_WITHIN

}  // namespace HWY_NAMESPACE
}  // namespace timeseries
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace timeseries {

#define ISOCHRON_WITHIN(T, name)                                                          \
    HWY_EXPORT(within##name);                                                             \
    template <>                                                                           \
    std::size_t valuesWithin<T>(std::span<const T> values, const Interval<T>& interval,   \
                                PlacesWithin<T>& places) {                                \
        return HWY_DYNAMIC_DISPATCH(within##name)(values.data(), values.size(), interval, \
                                                  places.data());                         \
    }
ISOCHRON_WIDE_TYPES(ISOCHRON_WITHIN)
#undef ISOCHRON_WITHIN

}  // namespace timeseries
#endif
