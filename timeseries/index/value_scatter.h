// A thread's points written to the buckets of a partition, by whole lines of the cache.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

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

}  // namespace timeseries
