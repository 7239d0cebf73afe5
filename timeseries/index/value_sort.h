// Sorting packed (key, index) pairs: Highway's vectorised quicksort (Wassenberg et al. 2022),
// compiled once.
#pragma once

#include <cstdint>
#include <span>

namespace timeseries {

struct WideKey {  // orders by key, then index
    std::uint64_t index, key;
};

// Both ascend.
void sortPacked(std::span<std::uint64_t> keys);
void sortPacked(std::span<WideKey> keys);

}  // namespace timeseries
