#include "timeseries/grid/pages.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
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

// Which pages of 4 KiB from here on the system may put into large ones: those of mappings that
// have "hg" among their flags. Empty where it knows no such thing.
std::vector<bool> mayBeLarge(const std::uint8_t* at, std::size_t pages) {
    std::vector<bool> may(pages);
    std::ifstream file("/proc/self/smaps");
    std::uintptr_t first = 0, end = 0;
    bool any = false;
    for (std::string line; std::getline(file, line);) {
        std::uintptr_t from = 0, to = 0;
        if (std::sscanf(line.c_str(), "%lx-%lx ", &from, &to) == 2) {
            first = from;
            end = to;
        } else if (line.starts_with("VmFlags:")) {
            any = any || line.find(" nh") != std::string::npos;
            if (line.find(" hg") == std::string::npos) continue;
            for (std::size_t i = 0; i < pages; ++i) {
                const auto page = reinterpret_cast<std::uintptr_t>(at) + i * 4096;
                if (page >= first && page < end) may[i] = true;
            }
        }
    }
    return any ? may : std::vector<bool>();
}

TEST(Pages, WhatWillBeWrittenComesInLargePagesThatItFillsByAQuarterAtLeast) {
    constexpr std::size_t kLarge = std::size_t{2} << 20, kBytes = 40 * kLarge;
    // Stretches as shares of a large page, behind the first that lies within.
    const std::vector<std::pair<double, double>> stretches = {
        {2, 3}, {5.74, 7.26}, {9.76, 11.24}, {14.5, 15.4}, {20.1, 20.9}, {0, 0}};
    const Pages<std::uint8_t> pages(kBytes, Filled::Sparsely);
    std::uint8_t* const base = pages.data();
    if (mayBeLarge(base, 1).empty()) GTEST_SKIP() << "the system has no large pages to ask for";
    const std::size_t aligned = (kLarge - reinterpret_cast<std::uintptr_t>(base) % kLarge) % kLarge;
    const auto byteOf = [&](double at) {
        return aligned + static_cast<std::size_t>(at * static_cast<double>(kLarge));
    };
    for (const auto& [from, to] : stretches)
        pages.willBeWritten(byteOf(from), byteOf(to) - byteOf(from));
    const std::vector<bool> may = mayBeLarge(base + aligned, 30 * kLarge / 4096);
    for (std::size_t page = 0; page < 30; ++page) {
        bool expected = false;
        for (const auto& [from, to] : stretches) {
            const auto at = static_cast<double>(page);
            expected |= to - from >= 1 && std::min(to, at + 1) - std::max(from, at) >= 0.25;
        }
        EXPECT_EQ(may[page * 512], expected) << page;
        EXPECT_EQ(may[page * 512 + 511], expected) << page;
    }
}

TEST(Pages, WhatWillBeWrittenLeavesWhatLiesBesideItAlone) {
    constexpr std::size_t kLarge = std::size_t{2} << 20;
    const Pages<std::uint8_t> pages(10 * kLarge, Filled::Sparsely);
    std::uint8_t* const base = pages.data();
    if (mayBeLarge(base, 1).empty()) GTEST_SKIP() << "the system has no large pages to ask for";
    // Of this memory a part, from an eighth of a large page on to an eighth before the end of one.
    std::uint8_t* const first =
        base + (kLarge - reinterpret_cast<std::uintptr_t>(base) % kLarge) % kLarge;
    const std::size_t bytes = 6 * kLarge - kLarge / 4;
    willBeWritten(first + kLarge / 8, bytes, 0, bytes);
    const std::vector<bool> may = mayBeLarge(first, 6 * 512);
    for (std::size_t page = 0; page < 6; ++page)
        EXPECT_EQ(may[page * 512 + 256], page > 0 && page < 5) << page;
}

}  // namespace
}  // namespace timeseries
