// A thread's points written to the buckets of a partition, by whole lines of the cache.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <sys/sysinfo.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "timeseries/index/field_points.h"
#include "timeseries/index/value_partition.h"

namespace timeseries {

inline constexpr std::size_t kLine = 16;  // points that are written at once

// What a thread has of a bucket and not written yet: the points whose places are in one line of
// the columns.
template <typename T>
struct alignas(64) Line {
    std::array<std::uint32_t, kLine> gridIndex;
    std::array<T, kLine> value;
};
struct alignas(64) IndexLine {
    std::array<std::uint32_t, kLine> gridIndex;
};

// Past the caches: nobody reads it soon.
template <typename V>
void stream(const std::array<V, kLine>& line, V* to) {
#ifdef __SSE2__
    const auto* from = reinterpret_cast<const __m128i*>(line.data());
    auto* at = reinterpret_cast<__m128i*>(to);
    for (std::size_t i = 0; i < sizeof line / sizeof(__m128i); ++i)
        _mm_stream_si128(at + i, _mm_load_si128(from + i));
#else
    std::ranges::copy(line, to);
#endif
}

// Writes the points of a thread's part to the slots that binOf() and slotOf say, by whole lines.
template <typename T, bool kValues>
class Scatter {
 public:
    // `next`: where this thread's first point of each slot goes.
    Scatter(Partition<T>& out, std::vector<std::uint64_t> next)
        : gridIndex_(out.gridIndex.data()),
          values_(out.values.data()),
          next_(std::move(next)),
          first_(next_),
          lines_(std::make_unique_for_overwrite<Room[]>(next_.size())) {}
    Scatter(const Scatter&) = delete;
    Scatter& operator=(const Scatter&) = delete;

    void put(std::size_t slot, std::size_t i, T value) {
        const std::uint64_t at = next_[slot]++;
        Room& line = lines_[slot];
        line.gridIndex[at % kLine] = static_cast<std::uint32_t>(i);
        if constexpr (kValues) line.value[at % kLine] = value;
        if (at % kLine == kLine - 1) write(slot, at + 1);
    }
    // What is left; the last thing done.
    void finish() {
        for (std::size_t slot = 0; slot < next_.size(); ++slot)
            if (next_[slot] % kLine != 0) copy(slot, next_[slot]);
#ifdef __SSE2__
        _mm_sfence();  // others may read what was streamed once this thread has ended
#endif
    }

 private:
    using Room = std::conditional_t<kValues, Line<T>, IndexLine>;

    void write(std::size_t slot, std::uint64_t end) {
        const std::uint64_t from = end - kLine;
        if (first_[slot] > from) return copy(slot, end);
        stream(lines_[slot].gridIndex, gridIndex_ + from);
        if constexpr (kValues) stream(lines_[slot].value, values_ + from);
    }
    // The part of the line before `end` that is this thread's.
    void copy(std::size_t slot, std::uint64_t end) {
        const std::uint64_t line = (end - 1) / kLine * kLine;
        for (std::uint64_t at = std::max(line, first_[slot]); at < end; ++at) {
            gridIndex_[at] = lines_[slot].gridIndex[at % kLine];
            if constexpr (kValues) values_[at] = lines_[slot].value[at % kLine];
        }
    }

    std::uint32_t* gridIndex_;
    T* values_;
    std::vector<std::uint64_t> next_;
    const std::vector<std::uint64_t> first_;
    std::unique_ptr<Room[]> lines_;
};

// Where each thread's points of each slot from `first` on begin, the slots one after the other from
// `at` on.
template <typename T>
std::vector<std::vector<std::uint64_t>> startsOf(const std::vector<Counted<T>>& parts,
                                                 std::size_t first, std::size_t end,
                                                 std::uint64_t at = 0) {
    std::vector<std::vector<std::uint64_t>> starts(parts.size(),
                                                   std::vector<std::uint64_t>(end - first));
    for (std::size_t slot = first; slot < end; ++slot)
        for (std::size_t k = 0; k < parts.size(); ++k) {
            starts[k][slot - first] = at;
            at += parts[k].inBin[slot];
        }
    return starts;
}

// The points from `among`, of which it calls back one after the other.
template <typename T, bool kValues, typename Slot, typename Among>
void scatterAll(const FieldPoints<T>& points, std::vector<std::vector<std::uint64_t>> starts,
                const Slot& slotOf, const Among& among,
                const std::function<void(std::size_t, std::size_t)>& passed, Partition<T>& out) {
    constexpr std::size_t kAtOnce = std::size_t{1} << 22;
    const std::size_t slots = starts.front().size();
    const auto threads = static_cast<unsigned>(starts.size());
    sharing(threads, [&](unsigned k) {
        Scatter<T, kValues> scatter(out, std::move(starts[k]));
        const auto put = [&](std::size_t i, T value) {
            const auto key = orderedKey(value);
            // Beyond them where a library has made this thread take the least numbers for 0.
            if (const std::size_t slot = slotOf(key); slot < slots)
                scatter.put(slot, i, valueOfKey<T>(key));
        };
        const std::size_t end = points.begin(k + 1, threads);
        for (std::size_t from = points.begin(k, threads), to = 0; from < end; from = to) {
            to = std::min(from + kAtOnce, end);
            among(from, to, put);
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

}  // namespace timeseries
