#include "timeseries/index/value_partition.h"

#include <sys/sysinfo.h>

#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <utility>

#include "timeseries/index/value_bins.h"
#include "timeseries/index/value_scatter.h"

namespace timeseries {
namespace {

using Passed = std::function<void(std::size_t, std::size_t)>;

// The points of a field that count.
template <typename T>
struct Points {
    std::span<const T> field;
    const std::vector<bool>& missing;
    std::span<const Interval<T>> kept;
    bool all;  // valid ones are kept

    Points(std::span<const T> values, const std::vector<bool>& marks,
           std::span<const Interval<T>> intervals)
        : field(values),
          missing(marks),
          kept(intervals),
          all(intervals.size() == 1 && holds(orderedKey(lowest())) &&
              holds(orderedKey(highest()))) {}

    bool keeps(T value) const {
        if (all) return true;
        for (const Interval<T>& i : kept)
            if (i.lo <= value && value <= i.hi) return true;
        return false;
    }
    // visit(i, value) for the valid ones of [from, to), ascending.
    template <typename Visit>
    void forEachValid(std::size_t from, std::size_t to, const Visit& visit) const {
        const bool marked = !missing.empty();
        const T* const values = field.data();
        for (std::size_t i = from; i < to; ++i) {
            const T value = values[i];
            if (value != value || (marked && missing[i])) continue;
            visit(i, value);
        }
    }
    // The part of thread k: never shares a word of marks.
    std::size_t begin(unsigned k, unsigned threads) const {
        return k == threads ? field.size() : field.size() * k / threads / 64 * 64;
    }

 private:
    static T lowest() {
        using L = std::numeric_limits<T>;
        return L::has_infinity ? static_cast<T>(-L::infinity()) : L::lowest();
    }
    static T highest() {
        using L = std::numeric_limits<T>;
        return L::has_infinity ? L::infinity() : L::max();
    }
    bool holds(OrderedKey<T> key) const {
        return orderedKey(kept[0].lo) <= key && key <= orderedKey(kept[0].hi);
    }
};

// What a thread found in its part of the field.
template <typename T>
struct Counted {
    std::uint64_t valid = 0;
    T least{}, greatest{};
    std::vector<std::uint32_t> inBin;  // of those that are kept
};

template <typename T, typename Bin>
Counted<T> countPart(const Points<T>& points, std::size_t from, std::size_t to, std::size_t bins,
                     const Bin& binOf) {
    // Neighbours are counted by turns: equal ones would wait for each other.
    constexpr std::size_t kTurns = sizeof(T) == 1 ? 8 : 1;
    std::vector<std::uint32_t> counts(bins * kTurns);
    std::uint32_t* const in = counts.data();
    const bool all = points.all;
    std::uint64_t valid = 0;
    T least{}, greatest{};
    points.forEachValid(from, to, [&](std::size_t i, T value) {
        if (valid++ == 0) least = greatest = value;
        least = std::min(least, value);
        greatest = std::max(greatest, value);
        if (all || points.keeps(value)) ++in[binOf(orderedKey(value)) * kTurns + i % kTurns];
    });
    for (std::size_t bin = 0; bin < bins; ++bin)
        in[bin] = std::accumulate(in + bin * kTurns, in + (bin + 1) * kTurns, 0u);
    counts.resize(bins);
    return {valid, least, greatest, std::move(counts)};
}

template <typename T, typename Bin>
std::vector<Counted<T>> countAll(const Points<T>& points, unsigned threads, std::size_t bins,
                                 const Bin& binOf) {
    std::vector<Counted<T>> parts(threads);
    sharing(threads, [&](unsigned k) {
        parts[k] =
            countPart(points, points.begin(k, threads), points.begin(k + 1, threads), bins, binOf);
    });
    return parts;
}

template <typename T>
void takeStatistics(const Points<T>& points, const std::vector<Counted<T>>& parts,
                    Partition<T>& out) {
    for (const Counted<T>& part : parts) {
        if (part.valid == 0) continue;
        if (out.valid == 0) out.leastValid = part.least, out.greatestValid = part.greatest;
        out.leastValid = std::min(out.leastValid, part.least);
        out.greatestValid = std::max(out.greatestValid, part.greatest);
        out.valid += part.valid;
    }
    const auto isFinite = [](T value) {
        return !std::numeric_limits<T>::has_infinity ||
               std::abs(static_cast<double>(value)) < std::numeric_limits<double>::infinity();
    };
    const auto add = [&](std::size_t, T value) {
        if (!isFinite(value)) return;
        const auto [least, greatest] = out.finite.value_or(std::pair(value, value));
        out.finite = {std::min(least, value), std::max(greatest, value)};
    };
    if (out.valid == 0) return;
    if (isFinite(out.leastValid) && isFinite(out.greatestValid))
        out.finite = {out.leastValid, out.greatestValid};
    else  // rare: the others are spared the look
        points.forEachValid(0, points.field.size(), add);
}

// Where each thread's points of each slot begin, the slots one after the other.
template <typename T>
std::vector<std::vector<std::uint64_t>> startsOf(std::vector<Counted<T>>& parts,
                                                 std::size_t slots) {
    std::vector<std::vector<std::uint64_t>> starts(parts.size(), std::vector<std::uint64_t>(slots));
    std::uint64_t at = 0;
    for (std::size_t slot = 0; slot < slots; ++slot)
        for (std::size_t k = 0; k < parts.size(); ++k) {
            starts[k][slot] = at;
            at += parts[k].inBin[slot];
        }
    return starts;
}

template <typename T, bool kValues, typename Slot>
void scatterAll(const Points<T>& points, std::vector<std::vector<std::uint64_t>> starts,
                const Slot& slotOf, const Passed& passed, Partition<T>& out) {
    constexpr std::size_t kAtOnce = std::size_t{1} << 22;
    const auto threads = static_cast<unsigned>(starts.size());
    sharing(threads, [&](unsigned k) {
        Scatter<T, kValues> scatter(out, std::move(starts[k]));
        const bool all = points.all;
        const std::size_t end = points.begin(k + 1, threads);
        for (std::size_t from = points.begin(k, threads), to = 0; from < end; from = to) {
            to = std::min(from + kAtOnce, end);
            points.forEachValid(from, to, [&](std::size_t i, T value) {
                if (!all && !points.keeps(value)) return;
                const auto key = orderedKey(value);
                scatter.put(slotOf(key), i, valueOfKey<T>(key));
            });
            if (passed) passed(from, to);
        }
        scatter.finish();
    });
}

// What will be filled at once where memory is plenty; else, as it is filled, a page after the
// other, while the field's are given back.
template <typename V>
Pages<V> roomFor(std::uint64_t points) {
    constexpr std::size_t kPlenty = 4;
    const auto bytes = static_cast<std::size_t>(points) * (sizeof(std::uint32_t) + sizeof(V));
    if (muchIsFree(kPlenty * bytes)) return Pages<V>(points);
    // Of pages that come one by one the system promises more than there is.
    struct sysinfo all {};
    if (sysinfo(&all) == 0 && points * sizeof(V) > (all.totalram + all.totalswap) * all.mem_unit)
        throw std::bad_alloc();
    return Pages<V>(points, Filled::Sparsely);
}

// Each value a bucket: a counting sort (8 and 16 bits).
template <typename T>
Partition<T> byEachValue(const Points<T>& points, unsigned threads, const Passed& passed) {
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
    scatterAll<T, false>(points, startsOf(parts, kKeys), itself, passed, out);
    return out;
}

// One bucket, not worth tables or threads.
template <typename T>
Partition<T> asOneBucket(const Points<T>& points) {
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

// Keys of the kept points among some that are spread over the field.
template <typename T>
std::vector<OrderedKey<T>> sampleOf(const Points<T>& points) {
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

template <typename T>
Partition<T> byBuckets(const Points<T>& points, unsigned threads, std::uint64_t most,
                       const Passed& passed) {
    std::vector<OrderedKey<T>> sample = sampleOf(points);
    const std::uint64_t inSample = most * sample.size() / points.field.size();
    const ValueBins<T> bins(std::move(sample), std::max<std::uint64_t>(inSample, 1));
    auto parts = countAll(points, threads, bins.count(), bins);
    Partition<T> out;
    takeStatistics(points, parts, out);
    const auto bucketOf = joinBins(parts, bins.leastKeys(), most, out);
    const std::vector<std::uint32_t> bucketOfPrefix = bins.ofWholePrefixes(bucketOf);
    for (Counted<T>& part : parts) {
        std::vector<std::uint32_t> inBucket(out.least.size());
        for (std::size_t bin = 0; bin < bucketOf.size(); ++bin)
            inBucket[bucketOf[bin]] += part.inBin[bin];
        part.inBin = std::move(inBucket);
    }
    out.gridIndex = roomFor<std::uint32_t>(out.points());
    out.values = roomFor<T>(out.points());
    scatterAll<T, true>(
        points, startsOf(parts, out.least.size()),
        [&, ofPrefix = bucketOfPrefix.data()](OrderedKey<T> key) {
            const std::uint32_t whole = ofPrefix[bins.prefixOf(key)];
            return std::size_t{whole != bins.kDivided ? whole : bucketOf[bins(key)]};
        },
        passed, out);
    return out;
}

}  // namespace

template <typename T>
Partition<T> partition(std::span<const T> field, const std::vector<bool>& missing,
                       std::span<const Interval<T>> kept, const PartitionSize& size) {
    const Points<T> points(field, missing, kept);
    // No part has more points than a count of 32 bits.
    const unsigned least = field.size() > std::numeric_limits<std::uint32_t>::max() ? 2 : 1;
    const unsigned threads =
        std::max(least, threadsFor(field.size(), size.worthAThread, size.threads));
    if (field.size() < size.least && (sizeof(T) > 1 || field.size() < 1024))
        return asOneBucket(points);
    if constexpr (sizeof(T) <= 2) {
        return byEachValue(points, threads, size.passed);
    } else {
        return byBuckets(points, threads, std::max(size.bucket, field.size() / size.mostBuckets),
                         size.passed);
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
