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
        // Those of one value are in order.
        const std::uint64_t from = std::max(points.first - first_, inFront_),
                            end = std::min(points.first - first_ + points.count,
                                           found_->size() - inBack_);
        if (from < end) found_->order({from, end - from});
    }
    T at(std::uint64_t place) const { return found_->values()[place - first_]; }
    void encode(std::uint64_t block, const BrickOrder& order, EncodedBlock& out) const {
        const std::uint64_t first = block * kStepBlock;
        const std::size_t count = std::min(kStepBlock, points() - first);
        encodeBlock<T>(found_->values().subspan(first - first_, count),
                       found_->gridIndex().subspan(first - first_, count), order, out);
    }

 private:
    // That all points of a bucket have of which more are found than at once: they come by grid
    // index, so that some of them can be found alone.
    std::optional<T> oneOfMany(std::size_t bucket) {
        const auto& begin = buckets_.about().begin;
        if (begin[bucket + 1] - begin[bucket] <= atOnce_) return std::nullopt;
        if (asked_ != bucket) one_ = buckets_.oneValue(bucket);
        asked_ = bucket;
        return one_;
    }
    // The buckets that these points lie in, but of many of one value those points alone.
    void fill(const Run& points) {
        const auto& begin = buckets_.about().begin;
        const std::uint64_t end =
            std::min(this->points(), points.first + std::max(points.count, atOnce_));
        auto first = static_cast<std::size_t>(std::ranges::upper_bound(begin, points.first) -
                                              begin.begin() - 1),
             behind =
                 static_cast<std::size_t>(std::ranges::lower_bound(begin, end) - begin.begin());
        const std::optional<T> front = oneOfMany(first);
        const std::optional<T> back = behind - first > 1 ? oneOfMany(behind - 1) : std::nullopt;
        first_ = front ? points.first : begin[first];
        inFront_ = front ? std::min(begin[++first], end) - first_ : 0;
        inBack_ = back ? end - begin[--behind] : 0;
        found_.reset();  // the system takes its pages for the next
        Partition<T> some = buckets_.points(first, behind, inFront_, inBack_);
        const auto put = [&](std::size_t bucket, std::uint64_t skipped, std::uint64_t at,
                             std::size_t count, T value) {
            buckets_.copyIndices(bucket, skipped, {some.gridIndex.data() + at, count});
            std::fill_n(some.values.data() + at, count, value);
        };
        if (front) put(first - 1, first_ - begin[first - 1], 0, inFront_, *front);
        if (back) put(behind, 0, some.points() - inBack_, inBack_, *back);
        found_.emplace(std::move(some), threads_);
    }

    std::span<const T> values_;
    const std::vector<bool>& missing_;
    const std::vector<Interval<T>> all_;
    const ValueBuckets<T> buckets_;
    const std::uint64_t atOnce_;
    const unsigned threads_;
    std::optional<std::size_t> asked_;  // a bucket, and its one value
    std::optional<T> one_;
    std::uint64_t first_ = 0;  // of those that were found
    std::optional<LazyColumn<T>> found_;
    std::uint64_t inFront_ = 0, inBack_ = 0;  // of these, of one value of many
};

}  // namespace timeseries
