#include "timeseries/grid/pages.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <vector>

namespace timeseries {
namespace {

// Of this process, in memory.
std::uint64_t residentBytes() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t all = 0, resident = 0;
    file >> all >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

TEST(Pages, WhatIsGivenBackTakesNoMemoryUntilItIsWritten) {
    constexpr std::size_t kBytes = std::size_t{64} << 20, kMost = std::size_t{4} << 20;
    std::vector<std::uint8_t> some(kBytes, 1);
    const std::uint64_t before = residentBytes();
    giveBack(&some[1], kBytes / 2);
    EXPECT_LE(residentBytes(), before - kBytes / 2 + kMost);
    // What lies beside it stays.
    EXPECT_EQ(some[0], 1);
    EXPECT_TRUE(std::all_of(some.begin() + kBytes / 2 + 1, some.end(),
                            [](std::uint8_t value) { return value == 1; }));
    std::ranges::fill(some, std::uint8_t{2});
    EXPECT_TRUE(std::ranges::all_of(some, [](std::uint8_t value) { return value == 2; }));
    giveBack(some.data(), 100);  // less than a page
    EXPECT_EQ(some[0], 2);
}

}  // namespace
}  // namespace timeseries
