// A field's points looked at and counted on several threads.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "timeseries/index/ordered_key.h"
#include "timeseries/index/value_partition.h"
#include "timeseries/index/values_within.h"
#include "timeseries/together.h"

namespace timeseries {

// The points of a field that count.
template <typename T>
struct FieldPoints {
    std::span<const T> field;
    const std::vector<bool>& missing;
    std::span<const Interval<T>> kept;
    bool all;  // valid ones are kept

    FieldPoints(std::span<const T> values, const std::vector<bool>& marks,
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
    // REQUIRES: it is not NaN.
    bool isKept(std::size_t i) const {
        return (missing.empty() || !missing[i]) && (all || keeps(field[i]));
    }
    // As forEachValid(), of those that are kept.
    template <typename Visit>
    void operator()(std::size_t from, std::size_t to, const Visit& visit) const {
        const bool any = all;
        forEachValid(from, to, [&](std::size_t i, T value) {
            if (any || keeps(value)) visit(i, value);
        });
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

// No part has more points than a count of 32 bits.
inline unsigned threadsOf(std::size_t points, const PartitionSize& size) {
    const unsigned least = points > std::numeric_limits<std::uint32_t>::max() ? 2 : 1;
    return std::max(least, threadsFor(points, size.worthAThread, size.threads));
}

// Of those points, the ones with values in an interval: most are passed over.
template <typename T>
struct PointsWithin {
    const FieldPoints<T>& points;
    Interval<T> interval;

    template <typename Visit>
    void operator()(std::size_t from, std::size_t to, const Visit& visit) const {
        const auto values = points.field;
        PlacesWithin<T> places;
        for (std::size_t begin = from; begin < to; begin += kWithinAtOnce) {
            const auto some = values.subspan(begin, std::min(kWithinAtOnce, to - begin));
            const std::size_t found = valuesWithin(some, interval, places);
            for (std::size_t k = 0; k < found; ++k) {
                const std::size_t i = begin + places[k];
                if (points.isKept(i)) visit(i, values[i]);
            }
        }
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
Counted<T> countPart(const FieldPoints<T>& points, std::size_t from, std::size_t to,
                     std::size_t bins, const Bin& binOf) {
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
std::vector<Counted<T>> countAll(const FieldPoints<T>& points, unsigned threads, std::size_t bins,
                                 const Bin& binOf) {
    std::vector<Counted<T>> parts(threads);
    sharing(threads, [&](unsigned k) {
        parts[k] =
            countPart(points, points.begin(k, threads), points.begin(k + 1, threads), bins, binOf);
    });
    return parts;
}

template <typename T>
void takeStatistics(const FieldPoints<T>& points, const std::vector<Counted<T>>& parts,
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

}  // namespace timeseries
