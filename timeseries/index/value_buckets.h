// The buckets of a partition by value, counted first and filled later, a part at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
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
    // The buckets [first, end) as if there were no others; with `before` and `after` room for so
    // many points of the bucket before them and of the one behind them, too. Throws std::bad_alloc.
    Partition<T> points(std::size_t first, std::size_t end, std::uint64_t before = 0,
                        std::uint64_t after = 0) const;
    // That all points of the bucket have; none where they differ. REQUIRES: it has a point.
    std::optional<T> oneValue(std::size_t bucket) const;
    // The grid indices, ascending, of some of the bucket's points: without the first so many.
    void copyIndices(std::size_t bucket, std::uint64_t first, std::span<std::uint32_t> to) const;

 private:
    struct Counts;
    std::unique_ptr<const Counts> counts_;
};

}  // namespace timeseries
