#include "timeseries/index/value_sort.h"

#include <hwy/contrib/sort/vqsort.h>

#include <cstddef>

namespace timeseries {

void sortPacked(std::span<std::uint64_t> keys) {
    hwy::Sorter()(keys.data(), keys.size(), hwy::SortAscending());
}

void sortPacked(std::span<WideKey> keys) {
    // Highway's uint128_t is {lo, hi} in this order; WideKey has its layout.
    static_assert(sizeof(WideKey) == sizeof(hwy::uint128_t) &&
                  offsetof(WideKey, key) == offsetof(hwy::uint128_t, hi));
    hwy::Sorter()(reinterpret_cast<hwy::uint128_t*>(keys.data()), keys.size(),
                  hwy::SortAscending());
}

}  // namespace timeseries
