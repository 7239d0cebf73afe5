#include "timeseries/index/value_buckets.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>

#include "timeseries/index/field_points.h"
#include "timeseries/index/value_bins.h"
#include "timeseries/index/value_scatter.h"
#include "timeseries/index/values_within.h"

namespace timeseries {
namespace {

// Keys of the kept points among some that are spread over the field.
template <typename T>
std::vector<OrderedKey<T>> sampleOf(const FieldPoints<T>& points) {
    constexpr std::size_t kSample = 1 << 14;
    // A step that has no factor in common with what grids are wide.
    const std::size_t n = points.field.size(), step = (n / kSample) | 1;
    std::vector<OrderedKey<T>> keys;
    for (std::size_t i = 0; i < n; i += step)
        points.forEachValid(i, i + 1, [&](std::size_t, T value) {
            if (points.keeps(value)) keys.push_back(orderedKey(value));
        });
    return keys;
}

// Neighbouring bins become a bucket while it has no more points than it should.
template <typename T>
std::vector<std::uint32_t> joinBins(const std::vector<Counted<T>>& parts,
                                    const std::vector<OrderedKey<T>>& leastKeys, std::uint64_t most,
                                    Partition<T>& out) {
    std::vector<std::uint32_t> bucketOf(leastKeys.size());
    for (std::size_t bin = 0; bin < leastKeys.size(); ++bin) {
        std::uint64_t count = 0;
        for (const Counted<T>& part : parts) count += part.inBin[bin];
        const bool none = out.least.empty();
        const std::uint64_t before = none ? 0 : out.begin.back() - out.begin[out.begin.size() - 2];
        if (none || (before > 0 && before + count > most)) {
            out.least.push_back(leastKeys[bin]);
            out.begin.push_back(out.begin.back());
        }
        out.begin.back() += count;
        bucketOf[bin] = static_cast<std::uint32_t>(out.least.size() - 1);
    }
    return bucketOf;
}

// Those that valid points of these buckets have: none in between are of others.
template <typename T>
Interval<T> valuesOf(const Partition<T>& all, std::size_t first, std::size_t end) {
    OrderedKey<T> least = std::max(all.least[first], orderedKey(all.leastValid)),
                  most = orderedKey(all.greatestValid);
    if (end < all.least.size()) most = std::min<OrderedKey<T>>(most, all.least[end] - 1);
    // No value has the key of -0, which compares as +0 does.
    if (valueOfKey<T>(most) == T{0} && most != orderedKey(T{0})) --most;
    return {valueOfKey<T>(least), valueOfKey<T>(most)};
}

}  // namespace

// What is counted, by each thread in its part of the field.
template <typename T>
struct ValueBuckets<T>::Counts {
    FieldPoints<T> points;
    std::function<void(std::size_t, std::size_t)> passed;
    ValueBins<T> bins;
    std::vector<Counted<T>> parts;        // in each bucket
    std::vector<std::uint32_t> bucketOf;  // a bin's
    std::vector<std::uint32_t> bucketOfPrefix;
    Partition<T> about;

    std::uint64_t inBucket(std::size_t bucket) const {
        return about.begin[bucket + 1] - about.begin[bucket];
    }
    // Into `out`, which has room, from place `at` on the points of buckets, those from `among`.
    template <typename Among>
    void scatter(std::size_t first, std::size_t end, const Among& among, std::uint64_t at,
                 Partition<T>& out) const {
        const auto slotOf = [&, ofPrefix = bucketOfPrefix.data()](OrderedKey<T> key) {
            const std::uint32_t whole = ofPrefix[bins.prefixOf(key)];
            return std::size_t{whole != bins.kDivided ? whole : bucketOf[bins(key)]} - first;
        };
        scatterAll<T, true>(points, startsOf(parts, first, end, at), slotOf, among, passed, out);
    }
    // visit(place, i, value) of a bucket's points, each thread of those in its part of the field
    // where this has any of the places [first, end).
    template <typename Visit>
    void forEachOf(std::size_t bucket, std::uint64_t first, std::uint64_t end,
                   const Visit& visit) const {
        const auto threads = static_cast<unsigned>(parts.size());
        const auto starts = startsOf(parts, bucket, bucket + 1);
        const PointsWithin<T> among{points, valuesOf(about, bucket, bucket + 1)};
        sharing(threads, [&](unsigned k) {
            std::uint64_t place = starts[k].front();
            if (place >= end || place + parts[k].inBin[bucket] <= first) return;
            among(points.begin(k, threads), points.begin(k + 1, threads),
                  [&](std::size_t i, T value) { visit(place++, i, value); });
        });
    }
};

template <typename T>
ValueBuckets<T>::ValueBuckets(std::span<const T> field, const std::vector<bool>& missing,
                              std::span<const Interval<T>> kept, const PartitionSize& size) {
    const FieldPoints<T> points(field, missing, kept);
    const unsigned threads = threadsOf(field.size(), size);
    const std::uint64_t most = std::max(size.bucket, field.size() / size.mostBuckets);
    std::vector<OrderedKey<T>> sample = sampleOf(points);
    const std::uint64_t inSample = most * sample.size() / std::max<std::size_t>(field.size(), 1);
    ValueBins<T> bins(std::move(sample), std::max<std::uint64_t>(inSample, 1));
    auto parts = countAll(points, threads, bins.count(), bins);
    Partition<T> about;
    takeStatistics(points, parts, about);
    auto bucketOf = joinBins(parts, bins.leastKeys(), most, about);
    auto bucketOfPrefix = bins.ofWholePrefixes(bucketOf);
    for (Counted<T>& part : parts) {
        std::vector<std::uint32_t> inBucket(about.least.size());
        for (std::size_t bin = 0; bin < bucketOf.size(); ++bin)
            inBucket[bucketOf[bin]] += part.inBin[bin];
        part.inBin = std::move(inBucket);
    }
    counts_ = std::make_unique<const Counts>(Counts{points, size.passed, std::move(bins),
                                                    std::move(parts), std::move(bucketOf),
                                                    std::move(bucketOfPrefix), std::move(about)});
}

template <typename T>
ValueBuckets<T>::~ValueBuckets() = default;

template <typename T>
const Partition<T>& ValueBuckets<T>::about() const {
    return counts_->about;
}

template <typename T>
Partition<T> ValueBuckets<T>::points(std::size_t first, std::size_t end, std::uint64_t before,
                                     std::uint64_t after) const {
    const Partition<T>& all = counts_->about;
    Partition<T> out;
    out.valid = all.valid;
    out.leastValid = all.leastValid;
    out.greatestValid = all.greatestValid;
    out.finite = all.finite;
    const auto add = [&](std::size_t bucket, std::uint64_t points) {
        out.least.push_back(all.least[bucket]);
        out.begin.push_back(out.begin.back() + points);
    };
    if (before > 0) add(first - 1, before);
    for (std::size_t b = first; b < end; ++b) add(b, counts_->inBucket(b));
    if (after > 0) add(end, after);
    out.gridIndex = roomFor<std::uint32_t>(out.points());
    out.values = roomFor<T>(out.points());
    const bool areAll = first == 0 && end == all.least.size();
    if (areAll)
        counts_->scatter(first, end, counts_->points, 0, out);
    else if (all.begin[first] < all.begin[end])
        counts_->scatter(first, end, PointsWithin<T>{counts_->points, valuesOf(all, first, end)},
                         before, out);
    return out;
}

template <typename T>
std::optional<T> ValueBuckets<T>::oneValue(std::size_t bucket) const {
    T first{};
    counts_->forEachOf(bucket, 0, 1, [&](std::uint64_t place, std::size_t, T value) {
        if (place == 0) first = value;
    });
    std::atomic<bool> differ = false;
    counts_->forEachOf(bucket, 0, counts_->inBucket(bucket),
                       [&](std::uint64_t, std::size_t, T value) {
                           if (value != first) differ.store(true, std::memory_order_relaxed);
                       });
    if (differ) return std::nullopt;
    return valueOfKey<T>(orderedKey(first));
}

template <typename T>
void ValueBuckets<T>::copyIndices(std::size_t bucket, std::uint64_t first,
                                  std::span<std::uint32_t> to) const {
    counts_->forEachOf(bucket, first, first + to.size(),
                       [&](std::uint64_t place, std::size_t i, T) {
                           if (place - first < to.size())  // else before them, or behind
                               to[place - first] = static_cast<std::uint32_t>(i);
                       });
}

#define ISOCHRON_BUCKETS(T, name) template class ValueBuckets<T>;
ISOCHRON_WIDE_TYPES(ISOCHRON_BUCKETS)
#undef ISOCHRON_BUCKETS

}  // namespace timeseries
