#include "timeseries/index/value_partition.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "timeseries/index/field_points.h"
#include "timeseries/index/value_buckets.h"
#include "timeseries/index/value_scatter.h"

namespace timeseries {
namespace {

// Each value a bucket: a counting sort (8 and 16 bits).
template <typename T>
Partition<T> byEachValue(const FieldPoints<T>& points, unsigned threads,
                         const std::function<void(std::size_t, std::size_t)>& passed) {
    constexpr std::size_t kKeys = std::size_t{1} << (8 * sizeof(T));
    const auto itself = [](OrderedKey<T> key) { return std::size_t{key}; };
    auto parts = countAll(points, threads, kKeys, itself);
    Partition<T> out;
    takeStatistics(points, parts, out);
    for (std::size_t key = 0; key < kKeys; ++key) {
        std::uint64_t count = 0;
        for (const Counted<T>& part : parts) count += part.inBin[key];
        if (count == 0) continue;
        out.least.push_back(static_cast<OrderedKey<T>>(key));
        out.begin.push_back(out.begin.back() + count);
    }
    out.least.shrink_to_fit();
    out.begin.shrink_to_fit();
    out.oneValueEach = true;
    out.gridIndex = roomFor<std::uint32_t>(out.points());
    out.values = Pages<T>(out.points());
    scatterAll<T, false>(points, startsOf(parts, 0, kKeys), itself, points, passed, out);
    return out;
}

// One bucket, not worth tables or threads.
template <typename T>
Partition<T> asOneBucket(const FieldPoints<T>& points) {
    auto parts = countAll(points, 1, 1, [](OrderedKey<T>) { return std::size_t{0}; });
    Partition<T> out;
    takeStatistics(points, parts, out);
    const std::uint64_t kept = parts[0].inBin[0];
    if (kept == 0) return out;
    out.least = {0};
    out.begin.push_back(kept);
    out.gridIndex = Pages<std::uint32_t>(kept);
    out.values = Pages<T>(kept);
    std::size_t at = 0;
    points.forEachValid(0, points.field.size(), [&](std::size_t i, T value) {
        if (!points.keeps(value)) return;
        out.gridIndex.data()[at] = static_cast<std::uint32_t>(i);
        out.values.data()[at++] = valueOfKey<T>(orderedKey(value));
    });
    return out;
}

}  // namespace

void expectOneList(std::uint64_t points) {
    if (points > (std::uint64_t{1} << 32))
        throw std::length_error(
            fmt::format("a step of {} points is more than the 2^32 that one list holds", points));
}

template <typename T>
Partition<T> partition(std::span<const T> field, const std::vector<bool>& missing,
                       std::span<const Interval<T>> kept, const PartitionSize& size) {
    if (field.size() < size.least && (sizeof(T) > 1 || field.size() < 1024))
        return asOneBucket(FieldPoints<T>(field, missing, kept));
    if constexpr (sizeof(T) <= 2) {
        return byEachValue(FieldPoints<T>(field, missing, kept), threadsOf(field.size(), size),
                           size.passed);
    } else {
        const ValueBuckets<T> buckets(field, missing, kept, size);
        return buckets.points(0, buckets.about().least.size());
    }
}

#define PARTITION(T)                                                              \
    template Partition<T> partition(std::span<const T>, const std::vector<bool>&, \
                                    std::span<const Interval<T>>, const PartitionSize&);
PARTITION(std::uint8_t)
PARTITION(std::int8_t)
PARTITION(std::uint16_t)
PARTITION(std::int16_t)
PARTITION(std::uint32_t)
PARTITION(std::int32_t)
PARTITION(std::uint64_t)
PARTITION(std::int64_t)
PARTITION(float)
PARTITION(double)
#undef PARTITION

}  // namespace timeseries
