// A step's points by value, put in order where somebody looks.
//
// They lie in buckets that ascend by value. Only a bucket that is looked into is sorted, once, by
// whoever looks first; others who look at the same time wait. Where it is not sorted, nobody has
// seen it, so nobody can tell: what is read is always in order of value, ties by grid index.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "timeseries/index/range_set.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/index/value_partition.h"

namespace timeseries {

// Every const member is safe to call from any thread, and may throw std::bad_alloc.
template <typename T>
class LazyColumn {
 public:
    LazyColumn(Partition<T> points, unsigned threads);

    std::uint64_t size() const { return points_.points(); }
    // Of all points; only those for which order() was called may be read.
    std::span<const T> values() const { return {points_.values.data(), size()}; }
    std::span<const std::uint32_t> gridIndex() const { return {points_.gridIndex.data(), size()}; }
    void order(const Run& run) const;
    void orderAll() const { order({0, size()}); }

    // The points with lo <= value <= hi: at most 2 (log2 n + 2) comparisons. Sorts the buckets that
    // the ends fall into, no other.
    Run find(const Interval<T>& interval) const;

    std::uint64_t bytes() const;          // when all pages are there
    std::uint64_t sortedBuckets() const;  // so far

 private:
    using Key = OrderedKey<T>;
    enum State : std::uint8_t { kRaw, kBusy, kOrdered };

    std::size_t buckets() const { return points_.least.size(); }
    // The bucket that a key falls into. REQUIRES: key >= least[0].
    std::size_t bucketOf(Key key) const;
    std::size_t bucketAt(std::uint64_t point) const;
    // How many points have smaller keys.
    std::uint64_t below(Key key) const;
    void orderBucket(std::size_t bucket) const;
    void sortBucket(std::size_t bucket) const;

    Partition<T> points_;
    unsigned threads_;
    std::unique_ptr<std::atomic<std::uint8_t>[]> state_;  // of each bucket
    mutable std::atomic<bool> allOrdered_ = false;
};

}  // namespace timeseries
