#include "timeseries/index/lazy_column.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "timeseries/index/value_sort.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::uint64_t kWorthAThread = 1 << 16;  // points to put in order

// Ascending by value, ties by grid index.
template <typename T>
void sortPairs(std::span<T> values, std::span<std::uint32_t> gridIndex) {
    using Packed = std::conditional_t<sizeof(T) <= 4, std::uint64_t, WideKey>;
    const std::size_t n = values.size();
    const auto packed = std::make_unique_for_overwrite<Packed[]>(n);
    for (std::size_t i = 0; i < n; ++i) {
        if constexpr (sizeof(T) <= 4) {
            packed[i] = std::uint64_t{orderedKey(values[i])} << 32 | gridIndex[i];
        } else {
            packed[i] = {gridIndex[i], orderedKey(values[i])};
        }
    }
    sortPacked(std::span(packed.get(), n));
    for (std::size_t i = 0; i < n; ++i) {
        if constexpr (sizeof(T) <= 4) {
            values[i] = valueOfKey<T>(static_cast<OrderedKey<T>>(packed[i] >> 32));
            gridIndex[i] = static_cast<std::uint32_t>(packed[i]);
        } else {
            values[i] = valueOfKey<T>(packed[i].key);
            gridIndex[i] = static_cast<std::uint32_t>(packed[i].index);
        }
    }
}

}  // namespace

template <typename T>
LazyColumn<T>::LazyColumn(Partition<T> points, unsigned threads)
    : points_(std::move(points)),
      threads_(threads),
      state_(std::make_unique<std::atomic<std::uint8_t>[]>(points_.least.size())) {}

template <typename T>
std::size_t LazyColumn<T>::bucketOf(Key key) const {
    const auto& least = points_.least;
    return static_cast<std::size_t>(std::upper_bound(least.begin(), least.end(), key) -
                                    least.begin()) -
           1;
}

template <typename T>
std::size_t LazyColumn<T>::bucketAt(std::uint64_t point) const {
    const auto& begin = points_.begin;
    return static_cast<std::size_t>(std::upper_bound(begin.begin(), begin.end(), point) -
                                    begin.begin()) -
           1;
}

template <typename T>
std::uint64_t LazyColumn<T>::below(Key key) const {
    // All or nothing is known without a look.
    if (size() == 0 || key <= orderedKey(points_.leastValid) || key <= points_.least[0]) return 0;
    if (key > orderedKey(points_.greatestValid)) return size();
    const std::size_t bucket = bucketOf(key);
    const std::uint64_t first = points_.begin[bucket], end = points_.begin[bucket + 1];
    if (key == points_.least[bucket]) return first;
    if (points_.oneValueEach) return end;
    orderBucket(bucket);
    // By keys: the one after an infinity's is no value's.
    const auto in = values().subspan(first, end - first);
    return first + static_cast<std::uint64_t>(std::ranges::lower_bound(in, key, {}, orderedKey<T>) -
                                              in.begin());
}

template <typename T>
Run LazyColumn<T>::find(const Interval<T>& interval) const {
    const Key hi = orderedKey(interval.hi);
    const std::uint64_t first = below(orderedKey(interval.lo));
    const bool last = hi == std::numeric_limits<Key>::max();
    const std::uint64_t end = last ? size() : below(static_cast<Key>(hi + 1));
    return {first, end - first};
}

template <typename T>
void LazyColumn<T>::order(const Run& run) const {
    if (run.count == 0 || allOrdered_.load(std::memory_order_acquire)) return;
    const std::size_t from = bucketAt(run.first), to = bucketAt(run.first + run.count - 1) + 1;
    std::vector<std::size_t> raw;
    std::uint64_t points = 0;
    for (std::size_t b = from; b < to; ++b)
        if (state_[b].load(std::memory_order_acquire) != kOrdered) {
            raw.push_back(b);
            points += points_.begin[b + 1] - points_.begin[b];
        }
    std::atomic<std::size_t> next{0};
    if (!raw.empty())
        sharing(threadsFor(points, kWorthAThread, threads_), [&](unsigned) {
            for (std::size_t i; (i = next++) < raw.size();) orderBucket(raw[i]);
        });
    if (run.count == size()) allOrdered_.store(true, std::memory_order_release);
}

template <typename T>
void LazyColumn<T>::orderBucket(std::size_t bucket) const {
    std::atomic<std::uint8_t>& state = state_[bucket];
    for (;;) {
        std::uint8_t is = state.load(std::memory_order_acquire);
        if (is == kOrdered) return;
        if (is == kBusy) {
            state.wait(kBusy, std::memory_order_acquire);
            continue;
        }
        if (!state.compare_exchange_strong(is, kBusy, std::memory_order_acquire)) continue;
        try {
            sortBucket(bucket);
        } catch (...) {  // as it was: who waits will try
            state.store(kRaw, std::memory_order_release);
            state.notify_all();
            throw;
        }
        state.store(kOrdered, std::memory_order_release);
        state.notify_all();
        return;
    }
}

template <typename T>
void LazyColumn<T>::sortBucket(std::size_t bucket) const {
    const std::uint64_t first = points_.begin[bucket], count = points_.begin[bucket + 1] - first;
    const std::span<T> values(points_.values.data() + first, count);
    if (points_.oneValueEach) {
        std::ranges::fill(values, valueOfKey<T>(points_.least[bucket]));
        return;
    }
    // One value a thousand times, above all: grid indices ascend already.
    if (std::ranges::is_sorted(values)) return;
    sortPairs(values, std::span(points_.gridIndex.data() + first, count));
}

template <typename T>
std::uint64_t LazyColumn<T>::bytes() const {
    return size() * (sizeof(T) + sizeof(std::uint32_t)) +
           points_.begin.capacity() * sizeof(points_.begin[0]) +
           points_.least.capacity() * sizeof(Key) + buckets();
}

template <typename T>
std::uint64_t LazyColumn<T>::sortedBuckets() const {
    return static_cast<std::uint64_t>(
        std::count_if(state_.get(), state_.get() + buckets(),
                      [](const auto& state) { return state.load() == kOrdered; }));
}

template class LazyColumn<std::uint8_t>;
template class LazyColumn<std::int8_t>;
template class LazyColumn<std::uint16_t>;
template class LazyColumn<std::int16_t>;
template class LazyColumn<std::uint32_t>;
template class LazyColumn<std::int32_t>;
template class LazyColumn<std::uint64_t>;
template class LazyColumn<std::int64_t>;
template class LazyColumn<float>;
template class LazyColumn<double>;

}  // namespace timeseries
