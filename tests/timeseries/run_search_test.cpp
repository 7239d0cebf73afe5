#include "timeseries/run_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

namespace timeseries {
namespace {

// The run is right, and found by few comparisons.
template <typename T>
void expectFewComparisons(const std::vector<T>& ascending, Interval<T> interval) {
    std::uint64_t calls = 0;
    const Run run = findRun(std::span<const T>(ascending), interval, [&](const T& a, const T& b) {
        ++calls;
        return a < b;
    });
    const auto inside = [&](T v) { return interval.lo <= v && v <= interval.hi; };
    const auto expected = std::count_if(ascending.begin(), ascending.end(), inside);
    ASSERT_EQ(run.count, static_cast<std::uint64_t>(expected));
    for (std::uint64_t i = run.first; i < run.first + run.count; ++i)
        ASSERT_TRUE(inside(ascending[i]));
    const double n = static_cast<double>(ascending.size());
    const double most = n > 0 ? 2 * (std::log2(n) + 1) : 0;
    ASSERT_LE(static_cast<double>(calls), most)
        << "n " << n << " range [" << interval.lo << ", " << interval.hi << "]";
}

TEST(FindRun, NeedsAtMostTwoLogNPlusOneComparisons) {
    for (int n = 0; n <= 66; ++n) {
        std::vector<int> ascending;
        for (int i = 0; i < n; ++i) ascending.push_back(2 * i + 1);
        for (int lo = 0; lo <= 2 * n + 1; ++lo)
            for (int hi = lo; hi <= 2 * n + 1; ++hi)
                ASSERT_NO_FATAL_FAILURE(expectFewComparisons<int>(ascending, {lo, hi}));
    }
}

TEST(FindRun, NeedsNoMoreComparisonsWithTiesOrAtPowersOfTwo) {
    std::mt19937_64 random(36);
    for (std::size_t n : {1023, 1024, 1025, 65535, 65536, 65537}) {
        std::vector<float> ascending(n);
        for (std::uint64_t distinct : {1, 2, 50, 1 << 20}) {
            for (float& value : ascending) value = static_cast<float>(random() % distinct);
            std::sort(ascending.begin(), ascending.end());
            for (int i = 0; i < 50; ++i) {
                auto lo = static_cast<float>(random() % distinct),
                     hi = static_cast<float>(random() % distinct);
                if (lo > hi) std::swap(lo, hi);
                ASSERT_NO_FATAL_FAILURE(expectFewComparisons<float>(ascending, {lo, hi}));
            }
        }
    }
}

}  // namespace
}  // namespace timeseries
