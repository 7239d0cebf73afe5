// How much memory the steps of a series may take.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "timeseries/machine_memory.h"

namespace app {

// Bytes, of --memory; 0: none was chosen. Set before steps are loaded.
inline std::atomic<std::uint64_t> chosenMemory{0};

// Bytes: those, else a quarter of what the process may have, for there is a step that is being
// sorted, and the pictures; 1 GiB at least.
inline std::uint64_t memoryBudget() {
    if (const std::uint64_t chosen = chosenMemory) return chosen;
    static const std::uint64_t quarter = timeseries::machineMemory() / 4;
    return std::max(quarter, std::uint64_t{1} << 30);
}

}  // namespace app
