// A step's points by value, put in order, or fetched, where somebody looks.
//
// They lie in buckets that ascend by value. Only a bucket that is looked into is sorted, once, by
// whoever looks first; others who look at the same time wait. Where it is not sorted, nobody has
// seen it, so nobody can tell: what is read is always in order of value, ties by grid index.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "timeseries/index/range_set.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/index/value_partition.h"

namespace timeseries {

// Where buckets are that are not in memory. Every member is safe to call from any thread.
template <typename T>
class BucketSource {
 public:
    virtual ~BucketSource() = default;
    // The bucket's points in order of value, ties by grid index.
    virtual void fill(std::size_t bucket, std::span<T> values,
                      std::span<std::uint32_t> gridIndex) const = 0;
    // How many of its keys are below this one.
    virtual std::uint64_t below(std::size_t bucket, OrderedKey<T> key) const = 0;
    virtual void willNeed(std::size_t firstBucket, std::size_t buckets) const = 0;
};

// Every const member is safe to call from any thread, and may throw std::bad_alloc, and what a
// source throws.
template <typename T>
class LazyColumn {
 public:
    // Without a source the points are in memory already, else there is only room for them.
    LazyColumn(Partition<T> points, unsigned threads,
               std::unique_ptr<const BucketSource<T>> source = nullptr);

    std::uint64_t size() const { return points_.points(); }
    // Of all points; only those for which order() was called may be read.
    std::span<const T> values() const { return {points_.values.data(), size()}; }
    std::span<const std::uint32_t> gridIndex() const { return {points_.gridIndex.data(), size()}; }
    void order(const Run& run) const;
    void orderAll() const { order({0, size()}); }
    // Copies what another column of the same source has in memory: the buckets of these runs, and
    // as many of the others, last looked at first, as all together take at most so many bytes.
    // REQUIRES: nobody has looked at this one.
    void takeOver(const LazyColumn& other, std::span<const Run> runs, std::uint64_t bytes);

    // The points with lo <= value <= hi: at most 2 (log2 n + 2) comparisons. Sorts the buckets that
    // the ends fall into, no other; of a source it reads their keys.
    Run find(const Interval<T>& interval) const;

    // How many points have smaller keys; as find().
    std::uint64_t below(OrderedKey<T> key) const;

    // When all pages are there; with a source, of the points that are, which in large pages may
    // take up to twice as much.
    std::uint64_t bytes() const;
    // What the buckets of these runs take when they are there.
    std::uint64_t bytes(std::span<const Run> runs) const;
    std::uint64_t sortedBuckets() const;  // so far

 private:
    using Key = OrderedKey<T>;
    enum State : std::uint8_t { kRaw, kBusy, kOrdered };

    std::size_t buckets() const { return points_.least.size(); }
    std::size_t bucketAt(std::uint64_t point) const;
    void orderBucket(std::size_t bucket) const;
    void sortBucket(std::size_t bucket) const;
    // What takeOver() takes of this one; they ascend.
    std::vector<std::size_t> lastLookedAt(std::span<const Run> runs, std::uint64_t bytes) const;
    // These buckets of the source, which ascend, will be there.
    void willFill(std::span<const std::size_t> buckets) const;
    std::uint64_t bucketBytes(std::size_t bucket) const;
    template <typename Do>
    void forEachBucket(std::span<const Run> runs, const Do& what) const;  // each once

    Partition<T> points_;
    unsigned threads_;
    std::unique_ptr<const BucketSource<T>> source_;
    mutable std::atomic<std::uint64_t> fetched_ = 0;      // points
    std::unique_ptr<std::atomic<std::uint8_t>[]> state_;  // of each bucket
    mutable std::atomic<bool> allOrdered_ = false;
    // With a source: how many looks there were, and which was the last at each bucket.
    mutable std::atomic<std::uint64_t> looks_ = 0;
    std::unique_ptr<std::atomic<std::uint64_t>[]> lastLook_;
};

}  // namespace timeseries
