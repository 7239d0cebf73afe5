// The list of a field of four or eight bytes a value, found a part after the other: its buckets are
// counted first, and filled and put in order where they are asked for.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/index/lazy_column.h"
#include "timeseries/index/step_blocks.h"
#include "timeseries/index/step_statistics.h"
#include "timeseries/index/value_buckets.h"
#include "timeseries/together.h"

namespace timeseries {

template <typename T>
class PartedList {
 public:
    // REQUIRES: a point; `atOnce`, of which so many are found and a bucket's more, are whole
    // blocks; the field outlives this.
    PartedList(const Field& field, std::uint64_t atOnce, unsigned threads)
        : values_(std::get<std::vector<T>>(field.values)),
          missing_(field.missing),
          all_(RangeSet::everything().toIntervals<T>()),
          buckets_(values_, missing_, all_, {.threads = threads}),
          atOnce_(atOnce),
          threads_(threads) {}

    std::uint64_t points() const { return buckets_.about().points(); }
    StepStatistics statistics() const { return statisticsOf(values_.size(), buckets_.about()); }
    // The points between the infinities.
    Run finite() const {
        const Partition<T>& about = buckets_.about();
        if (!about.finite) return {};
        const T least = about.finite->first, greatest = about.finite->second;
        if (least == about.leastValid && greatest == about.greatestValid) return {0, points()};
        const auto valid = [this](std::size_t i) { return missing_.empty() || !missing_[i]; };
        const std::uint64_t below = sumOf(values_.size(), [&](std::size_t i) -> std::uint64_t {
            return values_[i] < least && valid(i);
        });
        const std::uint64_t above = sumOf(values_.size(), [&](std::size_t i) -> std::uint64_t {
            return values_[i] > greatest && valid(i);
        });
        return {below, points() - below - above};
    }

    // What at() and encode() take next.
    void find(const Run& points) {
        if (!found_ || points.first + points.count > first_ + found_->size()) fill(points);
        found_->order({points.first - first_, points.count});
    }
    T at(std::uint64_t place) const { return found_->values()[place - first_]; }
    void encode(std::uint64_t block, const BrickOrder& order, EncodedBlock& out) const {
        const std::uint64_t first = block * kStepBlock;
        const std::size_t count = std::min(kStepBlock, points() - first);
        encodeBlock<T>(found_->values().subspan(first - first_, count),
                       found_->gridIndex().subspan(first - first_, count), order, out);
    }

 private:
    void fill(const Run& points) {
        const auto& begin = buckets_.about().begin;
        const std::uint64_t end =
            std::min(this->points(), points.first + std::max(points.count, atOnce_));
        const auto firstBucket = std::ranges::upper_bound(begin, points.first) - begin.begin() - 1,
                   endBucket = std::ranges::lower_bound(begin, end) - begin.begin();
        found_.reset();  // the system takes its pages for the next
        first_ = begin[static_cast<std::size_t>(firstBucket)];
        found_.emplace(buckets_.points(static_cast<std::size_t>(firstBucket),
                                       static_cast<std::size_t>(endBucket)),
                       threads_);
    }

    std::span<const T> values_;
    const std::vector<bool>& missing_;
    const std::vector<Interval<T>> all_;
    const ValueBuckets<T> buckets_;
    const std::uint64_t atOnce_;
    const unsigned threads_;
    std::uint64_t first_ = 0;  // of those that were found
    std::optional<LazyColumn<T>> found_;
};

}  // namespace timeseries
