// Sorting packed (key, index) pairs: Highway's vectorised quicksort (Wassenberg et al. 2022),
// compiled once.
#pragma once

#include <cstdint>
#include <span>

namespace timeseries {

struct WideKey {  // orders by key, then index
    std::uint64_t index, key;
    friend bool operator<(const WideKey& a, const WideKey& b) {
        return a.key != b.key ? a.key < b.key : a.index < b.index;
    }
};

// Both ascend.
void sortPacked(std::span<std::uint64_t> keys);
void sortPacked(std::span<WideKey> keys);

}  // namespace timeseries
