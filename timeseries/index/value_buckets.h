// The buckets of a partition by value, counted first and filled later, a part at a time.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "timeseries/index/value_partition.h"

namespace timeseries {

// Of values of four or eight bytes. Some are filled at a time, by a look at all values. What it is
// made of must outlive it.
template <typename T>
class ValueBuckets {
 public:
    // `size.passed`: only of who asks for points once.
    ValueBuckets(std::span<const T> field, const std::vector<bool>& missing,
                 std::span<const Interval<T>> kept, const PartitionSize& size = {});
    ~ValueBuckets();

    // All that a partition tells, without points.
    const Partition<T>& about() const;
    // The buckets [first, end) as if there were no others. Throws std::bad_alloc.
    Partition<T> points(std::size_t first, std::size_t end) const;

 private:
    struct Counts;
    std::unique_ptr<const Counts> counts_;
};

}  // namespace timeseries
