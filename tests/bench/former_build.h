// The index as it was built before it had buckets (at commit 533f11b): one thread, all points
// sorted at once. What today's build is measured against.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "timeseries/index/ordered_key.h"
#include "timeseries/index/value_sort.h"

namespace bench::former {

using timeseries::orderedKey;
using timeseries::sortPacked;
using timeseries::valueOfKey;
using timeseries::WideKey;

// Its memory was malloc's, in small pages: what is new in large ones (app/large_allocations.cpp) is
// today's.
template <typename T>
struct SmallPages {
    using value_type = T;
    SmallPages() = default;
    template <typename Other>
    explicit SmallPages(const SmallPages<Other>&) {}
    T* allocate(std::size_t count) {
        if (void* const at = std::malloc(count * sizeof(T))) return static_cast<T*>(at);
        throw std::bad_alloc();
    }
    void deallocate(T* at, std::size_t) noexcept { std::free(at); }
    friend bool operator==(const SmallPages&, const SmallPages&) { return true; }
};
template <typename T>
using Vector = std::vector<T, SmallPages<T>>;

template <typename T>
struct SortedPairs {
    Vector<T> values;             // ascending
    Vector<std::uint32_t> index;  // grid index of each value
};

template <typename T, typename Keep>
SortedPairs<T> countingSort(std::span<const T> field, std::size_t kept, const Keep& keep) {
    constexpr std::size_t kKeys = std::size_t{1} << (8 * sizeof(T));
    std::vector<std::size_t> next(kKeys + 1);
    for (std::size_t i = 0; i < field.size(); ++i)
        if (keep(i)) ++next[orderedKey(field[i]) + 1u];
    SortedPairs<T> out;
    out.values.reserve(kept);
    for (std::size_t key = 0; key < kKeys; ++key) {
        out.values.insert(out.values.end(), next[key + 1],
                          valueOfKey<T>(static_cast<std::make_unsigned_t<T>>(key)));
        next[key + 1] += next[key];
    }
    out.index.resize(kept);
    for (std::size_t i = 0; i < field.size(); ++i)
        if (keep(i)) out.index[next[orderedKey(field[i])]++] = static_cast<std::uint32_t>(i);
    return out;
}

template <typename T, typename Keep>
SortedPairs<T> packedSort(std::span<const T> field, std::size_t kept, const Keep& keep) {
    using Key = std::conditional_t<sizeof(T) == 4, std::uint64_t, WideKey>;
    const std::unique_ptr<Key[], void (*)(void*)> keys(
        static_cast<Key*>(std::malloc(kept * sizeof(Key))), std::free);
    std::size_t n = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
        if (!keep(i)) continue;
        if constexpr (sizeof(T) == 4) {
            keys[n++] = std::uint64_t{orderedKey(field[i])} << 32 | i;
        } else {
            keys[n++] = {i, orderedKey(field[i])};
        }
    }
    sortPacked(std::span(keys.get(), kept));
    SortedPairs<T> out{Vector<T>(kept), Vector<std::uint32_t>(kept)};
    for (std::size_t i = 0; i < kept; ++i) {
        if constexpr (sizeof(T) == 4) {
            out.values[i] = valueOfKey<T>(static_cast<std::uint32_t>(keys[i] >> 32));
            out.index[i] = static_cast<std::uint32_t>(keys[i]);
        } else {
            out.values[i] = valueOfKey<T>(keys[i].key);
            out.index[i] = static_cast<std::uint32_t>(keys[i].index);
        }
    }
    return out;
}

// Sorts the points of `field` for which keep(i) holds. REQUIRES: field.size() <= 2^32; no kept
// value is NaN; keep holds for exactly `kept` points.
template <typename T, typename Keep>
SortedPairs<T> sortByValue(std::span<const T> field, std::size_t kept, const Keep& keep) {
    if constexpr (sizeof(T) <= 2) {
        return countingSort(field, kept, keep);
    } else {
        return packedSort(field, kept, keep);
    }
}

// Of a field without missing points, everything kept. Counts the points that are no NaN, and finds
// the least and the greatest, as SortedStep::build did.
template <typename T>
SortedPairs<T> build(std::span<const T> field) {
    std::size_t points = 0;
    T least{}, greatest{};
    for (const T v : field) {
        if (v != v) continue;
        if (points++ == 0) least = greatest = v;
        least = std::min(least, v);
        greatest = std::max(greatest, v);
    }
    return sortByValue(field, points,
                       [&](std::size_t i) { return least <= field[i] && field[i] <= greatest; });
}

}  // namespace bench::former
