// A field's points put into buckets by value, on several threads: the part of a sort by value that
// has to be done before anything is asked. What is left, the order inside a bucket, is
// LazyColumn's (timeseries/index/lazy_column.h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "timeseries/grid/pages.h"
#include "timeseries/index/ordered_key.h"
#include "timeseries/index/range_set.h"
#include "timeseries/together.h"

namespace timeseries {

template <typename T>
struct Partition {
    // Bucket b has the points [begin[b], begin[b + 1]), with keys of at least least[b] and below
    // least[b + 1]. Ascending; least[0] is the least key that there is, or the first one's.
    std::vector<std::uint64_t> begin{0};
    std::vector<OrderedKey<T>> least;
    // Each bucket's greatest key, of a step on disk alone: there one value may fill several
    // buckets.
    std::vector<OrderedKey<T>> greatest;
    // In a bucket ascending by grid index, whatever the values are.
    Pages<std::uint32_t> gridIndex;
    // Of each point; -0 is +0. Where each bucket is one value they are not written.
    Pages<T> values;
    bool oneValueEach = false;
    // Of the field's valid points, neither missing nor NaN, before any was dropped. `least` and
    // `greatest` are the first such ones, if there is one.
    std::uint64_t valid = 0;
    T leastValid{}, greatestValid{};
    std::optional<std::pair<T, T>> finite = {};  // of those that are no infinities

    std::uint64_t points() const { return begin.back(); }
};

// How it is done: nothing of what is found depends on it.
struct PartitionSize {
    unsigned threads = sharingThreads();
    // Of a bucket, if its values differ enough: of so few that they are sorted in the second-level
    // cache, and of so many that there are not more buckets than a thread can write to by turns.
    std::uint64_t bucket = 1 << 16;
    std::uint64_t mostBuckets = 1 << 11;
    // Less is done before another thread has begun.
    std::size_t worthAThread = 1 << 17;
    // Fields of fewer points are one bucket: tables would outweigh them.
    std::uint64_t least = std::uint64_t{1} << (16 + 1);
    // Told of parts of the field, [first, last), that are not looked at any more, by each thread of
    // its own; may be empty.
    std::function<void(std::size_t first, std::size_t last)> passed = {};
};

// Throws std::length_error for more points than one list holds, 2^32.
void expectOneList(std::uint64_t points);

// The points of `field` that are not missing and whose values lie in `kept`, which is as
// RangeSet::toIntervals gives it. `missing` is empty or a mark a point. REQUIRES: at most 2^32
// points. Throws std::bad_alloc.
template <typename T>
Partition<T> partition(std::span<const T> field, const std::vector<bool>& missing,
                       std::span<const Interval<T>> kept, const PartitionSize& size = {});

}  // namespace timeseries
