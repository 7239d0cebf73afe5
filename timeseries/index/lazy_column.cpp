#include "timeseries/index/lazy_column.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "timeseries/grid/with_type.h"
#include "timeseries/index/pair_sort.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::uint64_t kWorthAThread = 1 << 16;  // points to put in order

// what(first, count) for those that follow each other, of some that ascend.
template <typename What>
void forEachStretch(std::span<const std::size_t> numbers, const What& what) {
    for (std::size_t i = 0, next; i < numbers.size(); i = next) {
        for (next = i + 1; next < numbers.size() && numbers[next] == numbers[next - 1] + 1;) ++next;
        what(numbers[i], next - i);
    }
}

}  // namespace

template <typename T>
LazyColumn<T>::LazyColumn(Partition<T> points, unsigned threads,
                          std::unique_ptr<const BucketSource<T>> source)
    : points_(std::move(points)),
      threads_(threads),
      source_(std::move(source)),
      state_(std::make_unique<std::atomic<std::uint8_t>[]>(points_.least.size())) {
    if (source_) lastLook_ = std::make_unique<std::atomic<std::uint64_t>[]>(points_.least.size());
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
    // Buckets before the first one that begins at this key or beyond hold smaller keys, the last of
    // them perhaps others, too.
    const auto& least = points_.least;
    const auto next =
        static_cast<std::size_t>(std::ranges::lower_bound(least, key) - least.begin());
    const std::size_t bucket = next - 1;
    const std::uint64_t first = points_.begin[bucket], end = points_.begin[next];
    const bool apart = points_.greatest.empty() ? next < buckets() && least[next] == key
                                                : points_.greatest[bucket] < key;
    if (apart || points_.oneValueEach) return end;
    if (source_ && state_[bucket].load(std::memory_order_acquire) != kOrdered)
        return first + source_->below(bucket, key);
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
    if (run.count == 0 || (!source_ && allOrdered_.load(std::memory_order_acquire))) return;
    const std::size_t from = bucketAt(run.first), to = bucketAt(run.first + run.count - 1) + 1;
    if (source_) {
        const std::uint64_t look = looks_.fetch_add(1, std::memory_order_relaxed) + 1;
        for (std::size_t b = from; b < to; ++b) lastLook_[b].store(look, std::memory_order_relaxed);
        if (allOrdered_.load(std::memory_order_acquire)) return;
    }
    std::vector<std::size_t> raw;
    std::uint64_t points = 0;
    for (std::size_t b = from; b < to; ++b)
        if (state_[b].load(std::memory_order_acquire) != kOrdered) {
            raw.push_back(b);
            points += points_.begin[b + 1] - points_.begin[b];
        }
    std::atomic<std::size_t> next{0};
    if (source_) {
        forEachStretch(
            raw, [&](std::size_t first, std::size_t count) { source_->willNeed(first, count); });
        willFill(raw);
    }
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
    const std::span<std::uint32_t> gridIndex(points_.gridIndex.data() + first, count);
    if (source_) {
        source_->fill(bucket, values, gridIndex);
        fetched_ += count;
        return;
    }
    if (points_.oneValueEach) {
        std::ranges::fill(values, valueOfKey<T>(points_.least[bucket]));
        return;
    }
    // One value a thousand times, above all: grid indices ascend already.
    if (std::ranges::is_sorted(values)) return;
    const auto keys = std::make_unique_for_overwrite<Key[]>(count);
    std::ranges::transform(values, keys.get(), [](T value) { return orderedKey(value); });
    const auto room = std::make_unique_for_overwrite<PackedPoint<T>[]>(count);
    sortPairs<T>(std::span<const Key>(keys.get(), count), gridIndex, values,
                 std::span(room.get(), count));
}

template <typename T>
std::uint64_t LazyColumn<T>::bytes() const {
    return (source_ ? fetched_.load() : size()) * (sizeof(T) + sizeof(std::uint32_t)) +
           points_.begin.capacity() * sizeof(points_.begin[0]) +
           (points_.least.capacity() + points_.greatest.capacity()) * sizeof(Key) +
           buckets() * (source_ ? 1 + sizeof lastLook_[0] : 1);
}

template <typename T>
std::uint64_t LazyColumn<T>::bucketBytes(std::size_t bucket) const {
    return (points_.begin[bucket + 1] - points_.begin[bucket]) *
           (sizeof(T) + sizeof(std::uint32_t));
}

template <typename T>
template <typename Do>
void LazyColumn<T>::forEachBucket(std::span<const Run> runs, const Do& what) const {
    std::size_t next = 0;  // behind the last one that was met
    for (const Run& run : runs) {
        if (run.count == 0) continue;
        const std::size_t end = bucketAt(run.first + run.count - 1) + 1;
        for (std::size_t b = std::max(bucketAt(run.first), next); b < end; ++b) what(b);
        next = std::max(next, end);
    }
}

template <typename T>
std::uint64_t LazyColumn<T>::bytes(std::span<const Run> runs) const {
    std::uint64_t bytes = 0;
    forEachBucket(runs, [&](std::size_t bucket) { bytes += bucketBytes(bucket); });
    return bytes;
}

template <typename T>
std::vector<std::size_t> LazyColumn<T>::lastLookedAt(std::span<const Run> runs,
                                                     std::uint64_t bytes) const {
    std::vector<std::size_t> chosen;
    std::vector<bool> isChosen(buckets());
    std::uint64_t left = bytes;
    const auto choose = [&](std::size_t b) {
        chosen.push_back(b);
        isChosen[b] = true;
        left -= std::min(left, bucketBytes(b));
    };
    const auto isThere = [&](std::size_t b) {
        return state_[b].load(std::memory_order_acquire) == kOrdered;
    };
    forEachBucket(runs, [&](std::size_t b) {
        if (isThere(b)) choose(b);
    });
    // As they were looked at by now, whatever others look at meanwhile.
    std::vector<std::pair<std::uint64_t, std::size_t>> byLook;
    for (std::size_t b = 0; b < buckets(); ++b)
        if (isThere(b) && !isChosen[b])
            byLook.emplace_back(lastLook_[b].load(std::memory_order_relaxed), b);
    std::ranges::sort(byLook, std::greater());
    for (const auto& [look, b] : byLook) {
        if (bucketBytes(b) > left) break;
        choose(b);
    }
    std::ranges::sort(chosen);
    return chosen;
}

template <typename T>
void LazyColumn<T>::takeOver(const LazyColumn& other, std::span<const Run> runs,
                             std::uint64_t bytes) {
    looks_.store(other.looks_.load());
    const std::vector<std::size_t> taken = other.lastLookedAt(runs, bytes);
    willFill(taken);
    for (const std::size_t b : taken) {
        const std::uint64_t first = points_.begin[b], count = points_.begin[b + 1] - first;
        std::copy_n(other.points_.values.data() + first, count, points_.values.data() + first);
        std::copy_n(other.points_.gridIndex.data() + first, count,
                    points_.gridIndex.data() + first);
        lastLook_[b].store(other.lastLook_[b].load(std::memory_order_relaxed));
        state_[b].store(kOrdered, std::memory_order_release);
        fetched_ += count;
    }
}

template <typename T>
void LazyColumn<T>::willFill(std::span<const std::size_t> buckets) const {
    forEachStretch(buckets, [&](std::size_t bucket, std::size_t count) {
        const std::uint64_t first = points_.begin[bucket],
                            points = points_.begin[bucket + count] - first;
        points_.values.willBeWritten(first, points);
        points_.gridIndex.willBeWritten(first, points);
    });
}

template <typename T>
std::uint64_t LazyColumn<T>::sortedBuckets() const {
    return static_cast<std::uint64_t>(
        std::count_if(state_.get(), state_.get() + buckets(),
                      [](const auto& state) { return state.load() == kOrdered; }));
}

#define ISOCHRON_TYPE(T) template class LazyColumn<T>;
ISOCHRON_EACH_TYPE(ISOCHRON_TYPE)
#undef ISOCHRON_TYPE

}  // namespace timeseries
