// The points that stand for all.
#include "render/points/subset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace render {
namespace {

using RunOfPoints = timeseries::Run;
using testing::ElementsAreArray;

std::vector<std::uint64_t> bruteForce(const RunOfPoints& run, std::uint32_t stride) {
    std::vector<std::uint64_t> members;
    for (std::uint64_t p = run.first; p < run.first + run.count; ++p)
        if (inSubset(p, stride)) members.push_back(p);
    return members;
}

// Within a period, across its ends, over several, empty; of steps beyond 2^32 points too.
std::vector<RunOfPoints> runs() {
    constexpr std::uint64_t kPeriod = kSubsetPeriod;
    std::vector<RunOfPoints> runs = {
        {0, 0},           {0, 1},           {kPeriod - 1, 2},
        {kPeriod, 7},     {0, kPeriod},     {kPeriod, 2 * kPeriod},
        {5, 3 * kPeriod}, {kPeriod - 1, 1}, {kPeriod * 200'000 - 9, 99}};
    std::mt19937_64 random(5);
    for (int i = 0; i < 20; ++i)
        runs.push_back({random() % (4 * kPeriod), random() % (2 * kPeriod)});
    return runs;
}

TEST(Subset, CountsAndVisitsItsMembersAscending) {
    for (std::uint32_t stride = 1; stride <= kMaxStride; stride *= 2)
        for (const RunOfPoints& run : runs()) {
            const auto expected = bruteForce(run, stride);
            EXPECT_EQ(subsetCount(run, stride), expected.size()) << run.first << " + " << run.count;
            std::vector<std::uint64_t> visited;
            forEachInSubset(run, stride, [&](std::uint64_t p) { visited.push_back(p); });
            EXPECT_EQ(visited, expected) << run.first << " + " << run.count;
        }
}

TEST(Subset, IsAllPointsAtStrideOneAndPartOfEverySmallerStrides) {
    for (std::uint64_t p = 0; p < 2 * kSubsetPeriod; ++p) {
        ASSERT_TRUE(inSubset(p, 1));
        for (std::uint32_t stride = 2; stride <= kMaxStride; stride *= 2)
            ASSERT_LE(inSubset(p, stride), inSubset(p, stride / 2)) << p << ' ' << stride;
    }
}

TEST(Subset, HasItsExactShareOfAnyPeriod) {
    for (std::uint32_t stride = 1; stride <= kMaxStride; stride *= 2)
        for (const std::uint64_t first : {0u, 1u, 1000u, 32767u, 98765u})
            EXPECT_EQ(subsetCount({first, kSubsetPeriod}, stride), kSubsetPeriod / stride);
}

TEST(Subset, IsEvenOverEveryRun) {
    // The count of points below p less p / stride is, up to its own spread, that of any run: a run
    // is the difference of two. Periods repeat it, having their exact share.
    for (std::uint32_t stride = 1; stride <= kMaxStride; stride *= 2) {
        double ahead = 0, most = 0, least = 0;
        for (std::uint64_t p = 0; p < kSubsetPeriod; ++p) {
            ahead += (inSubset(p, stride) ? 1.0 : 0.0) - 1.0 / stride;
            most = std::max(most, ahead);
            least = std::min(least, ahead);
        }
        EXPECT_LE(most - least, kSubsetUnevenness) << stride;
    }
}

TEST(Subset, UnevennessIsTheBoundOfDenjoyAndKoksma) {
    // K / 2^15 from the ranks themselves, its convergents' denominators, and the most of them that
    // a greedy sum of any number of points below 2^15 takes; each contributes at most 2.
    std::uint64_t a = subsetRank(1), b = kSubsetPeriod;
    ASSERT_EQ(a % 2, 1u) << "or ranks would not be a permutation";
    std::vector<std::uint64_t> denominators = {0, 1};
    while (a > 0) {
        const std::size_t n = denominators.size();
        denominators.push_back(b / a * denominators[n - 1] + denominators[n - 2]);
        b = std::exchange(a, b % a);
    }
    ASSERT_EQ(denominators.back(), kSubsetPeriod);
    std::uint64_t most = 0;
    for (std::uint64_t n = 0; n < kSubsetPeriod; ++n) {
        std::uint64_t rest = n, terms = 0;
        for (auto q = denominators.rbegin(); q + 1 != denominators.rend(); ++q) {
            terms += rest / *q;
            rest %= *q;
        }
        most = std::max(most, terms);
    }
    EXPECT_EQ(2 * most, kSubsetUnevenness);
}

TEST(Subset, TakesNoWholePlanesOfEqualValues) {
    // Equal values stand in grid order: of a plane of n^2 points, every row and every column has
    // its share, give or take as many as a plain stride would be wrong by.
    for (const std::uint64_t n : {32u, 64u, 128u, 256u}) {
        const std::uint32_t stride = 4;
        std::vector<std::uint64_t> ofRow(n), ofColumn(n);
        for (std::uint64_t p = 0; p < n * n; ++p)
            if (inSubset(p, stride)) {
                ++ofRow[p / n];
                ++ofColumn[p % n];
            }
        for (const auto& counts : {ofRow, ofColumn})
            for (const std::uint64_t count : counts) {
                EXPECT_GE(count, n / stride / 2) << n;
                EXPECT_LE(count, n / stride * 2) << n;
            }
    }
}

}  // namespace
}  // namespace render
