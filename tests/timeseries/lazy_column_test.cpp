#include "timeseries/index/lazy_column.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <bit>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/selection_oracle.h"
#include "timeseries/index/value_buckets.h"
#include "timeseries/index/values_within.h"

namespace timeseries {
namespace {

using Runs = std::vector<timeseries::Run>;

template <typename T>
struct World {
    std::vector<T> field;
    std::vector<bool> missing;
    std::vector<Interval<T>> kept = RangeSet::everything().toIntervals<T>();

    bool holds(std::size_t i) const {
        if (!missing.empty() && missing[i]) return false;
        return std::ranges::any_of(kept, [&](const Interval<T>& k) {
            return k.lo <= field[i] && field[i] <= k.hi;  // NaN: no
        });
    }
    // Grid indices by value, ties by index: what a step must show.
    std::vector<std::uint32_t> sorted() const {
        std::vector<std::uint32_t> points;
        for (std::size_t i = 0; i < field.size(); ++i)
            if (holds(i)) points.push_back(static_cast<std::uint32_t>(i));
        std::ranges::stable_sort(points, [&](auto a, auto b) { return field[a] < field[b]; });
        return points;
    }
    // By comparing every value.
    timeseries::Run filter(const Interval<T>& in) const {
        timeseries::Run run;
        for (std::size_t i = 0; i < field.size(); ++i) {
            if (!holds(i)) continue;
            run.first += field[i] < in.lo;
            run.count += in.lo <= field[i] && field[i] <= in.hi;
        }
        return run;
    }
    // Of a field that is something else wherever it is not looked at any more.
    LazyColumn<T> column(PartitionSize size) const {
        std::vector<T> given = field;
        size.passed = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) given[i] = field[field.size() - 1 - i];
        };
        return LazyColumn<T>(partition<T>(given, missing, kept, size), size.threads);
    }
};

// Awkward values, any bits, values crowded together, or ties; some missing, some dropped.
template <typename T>
World<T> randomWorld(std::mt19937_64& random, std::size_t n) {
    const std::vector<T> awkward = oracle::awkwardValues<T>();
    const std::uint64_t shape = random() % 4;
    const T around = awkward[random() % awkward.size()];
    World<T> world;
    for (std::size_t i = 0; i < n; ++i) {
        T v = awkward[random() % awkward.size()];
        if (shape == 1) v = oracle::anyValue<T>(random);
        if (shape == 2) {
            v = around;
            for (std::uint64_t k = random() % 40; k > 0; --k) v = oracle::neighbour(v, 1);
        }
        if (shape == 3) v = random() % 2 == 0 ? T{0} : v;
        world.field.push_back(v);
    }
    if (random() % 2 == 0)
        for (std::size_t i = 0; i < n; ++i) world.missing.push_back(random() % 4 == 0);
    if (random() % 3 == 0)
        world.kept = RangeSet(oracle::randomRanges(random, 3, oracle::awkwardNumbers()))
                         .template toIntervals<T>();
    return world;
}

template <typename T>
T boundOf(const World<T>& world, std::mt19937_64& random) {
    const std::vector<T> awkward = oracle::awkwardValues<T>();
    T v = random() % 2 == 0 ? awkward[random() % awkward.size()]
                            : world.field[random() % world.field.size()];
    if (v != v) v = T{0};
    return oracle::neighbour(v, static_cast<int>(random() % 3) - 1);
}

// What is shown of these points is what a sort of all would have there.
template <typename T>
void expectInOrder(const LazyColumn<T>& column, const World<T>& world,
                   const std::vector<std::uint32_t>& sorted, const timeseries::Run& run) {
    for (std::uint64_t p = run.first; p < run.first + run.count; ++p) {
        ASSERT_EQ(column.gridIndex()[p], sorted[p]) << "point " << p;
        ASSERT_EQ(column.values()[p], world.field[sorted[p]]) << "point " << p;
    }
}

template <typename T>
class LazyColumnOf : public testing::Test {};
using ValueTypes =
    testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                   std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(LazyColumnOf, ValueTypes);

TYPED_TEST(LazyColumnOf, FindsWhatAFilterFindsHoweverThePointsAreDivided) {
    using T = TypeParam;
    std::mt19937_64 random(51);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const World<T> world = randomWorld<T>(random, 1 + random() % 700);
        const auto sorted = world.sorted();
        PartitionSize size{.threads = static_cast<unsigned>(1 + random() % 3),
                           .bucket = 1 + random() % 40,
                           .mostBuckets = 1 << 20,
                           .worthAThread = 1,
                           .least = 0};
        if (i % 4 == 0) size.least = 1 << 20;  // one bucket
        const LazyColumn<T> column = world.column(size);
        ASSERT_EQ(column.size(), sorted.size());
        for (int k = 0; k < 30; ++k) {
            Interval<T> in{boundOf(world, random), boundOf(world, random)};
            if (in.hi < in.lo) std::swap(in.lo, in.hi);
            const timeseries::Run found = column.find(in), expected = world.filter(in);
            ASSERT_EQ(found.count, expected.count) << +in.lo << " to " << +in.hi;
            ASSERT_EQ(found.first, expected.first) << +in.lo << " to " << +in.hi;
            if (k % 3 != 0) continue;
            column.order(found);
            ASSERT_NO_FATAL_FAILURE(expectInOrder(column, world, sorted, found));
        }
        column.orderAll();
        ASSERT_NO_FATAL_FAILURE(expectInOrder(column, world, sorted, {0, column.size()}));
    }
}

// All that a step promises while several look at points of which none was asked for yet.
TYPED_TEST(LazyColumnOf, FirstLooksFromSeveralThreadsAtOnceSeeOneOrder) {
    using T = TypeParam;
    constexpr int kThreads = 4;
    std::mt19937_64 random(52);
    for (int round = 0; round < 8; ++round) {
        World<T> world;
        for (int i = 0; i < 6000; ++i) world.field.push_back(oracle::anyValue<T>(random));
        std::ranges::replace_if(
            world.field, [](T v) { return v != v; }, T{1});
        const auto sorted = world.sorted();
        const LazyColumn<T> column =
            world.column({.threads = 2, .bucket = 300, .worthAThread = 1, .least = 0});
        std::vector<Interval<T>> asked;
        Runs expected;
        for (int k = 0; k < 12; ++k) {
            Interval<T> in{boundOf(world, random), boundOf(world, random)};
            if (in.hi < in.lo) std::swap(in.lo, in.hi);
            asked.push_back(in);
            expected.push_back(world.filter(in));
        }
        std::barrier start(kThreads);
        std::vector<int> wrong(kThreads);
        {
            std::vector<std::jthread> threads;
            for (int t = 0; t < kThreads; ++t)
                threads.emplace_back([&, t] {
                    start.arrive_and_wait();
                    for (std::size_t k = 0; k < asked.size(); ++k) {
                        const timeseries::Run run = column.find(asked[k]);
                        if (!(run.count == expected[k].count)) ++wrong[static_cast<std::size_t>(t)];
                        column.order(run);
                        for (std::uint64_t p = run.first; p < run.first + run.count; ++p)
                            wrong[static_cast<std::size_t>(t)] +=
                                column.gridIndex()[p] != sorted[p] ||
                                column.values()[p] != world.field[sorted[p]];
                    }
                });
        }
        EXPECT_EQ(wrong, std::vector<int>(kThreads)) << "round " << round;
    }
}

// Distinct values without order in 64 buckets or more.
World<float> scattered(std::size_t n) {
    World<float> world;
    for (std::size_t i = 0; i < n; ++i)
        world.field.push_back(static_cast<float>(i * 7919 % n));  // n is no multiple of this prime
    return world;
}
const PartitionSize kSmall{.threads = 2, .bucket = 64, .worthAThread = 1 << 10, .least = 0};

TEST(LazyColumn, SortsOnlyWhereAnEndOfARangeFalls) {
    const World<float> world = scattered(1 << 13);
    const LazyColumn<float> column = world.column(kSmall);
    EXPECT_EQ(column.find({1000.5f, 6000.5f}), (timeseries::Run{1001, 5000}));
    EXPECT_LE(column.sortedBuckets(), 2u);
    EXPECT_GE(column.sortedBuckets(), 1u);
    const auto before = column.sortedBuckets();
    EXPECT_EQ(column.find({1000.5f, 6000.5f}), (timeseries::Run{1001, 5000}));
    EXPECT_EQ(column.sortedBuckets(), before);
}

TEST(LazyColumn, AllOrNothingSortsNothing) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const World<float> world = scattered(1 << 13);
    const LazyColumn<float> column = world.column(kSmall);
    EXPECT_EQ(column.find({-kInfinity, kInfinity}), (timeseries::Run{0, 1 << 13}));
    EXPECT_EQ(column.find({0, (1 << 13) - 1}), (timeseries::Run{0, 1 << 13}));
    EXPECT_EQ(column.find({8192, 9000}).count, 0u);
    EXPECT_EQ(column.find({-9, -1}).count, 0u);
    EXPECT_EQ(column.sortedBuckets(), 0u);
}

TEST(LazyColumn, LooksOrderOnlyWhatTheyTouch) {
    const World<float> world = scattered(1 << 13);
    const auto sorted = world.sorted();
    const LazyColumn<float> column = world.column(kSmall);
    column.order({4000, 10});
    EXPECT_LE(column.sortedBuckets(), 2u);
    ASSERT_NO_FATAL_FAILURE(expectInOrder(column, world, sorted, {4000, 10}));
    column.order({4000, 0});
    EXPECT_LE(column.sortedBuckets(), 2u);
}

template <typename T>
class ValueBucketsOf : public testing::Test {};
using WideTypes =
    testing::Types<std::uint32_t, std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(ValueBucketsOf, WideTypes);

TYPED_TEST(ValueBucketsOf, PartsAreTheWholeListCut) {
    using T = TypeParam;
    std::mt19937_64 random(59);
    for (int round = 0; round < 60; ++round) {
        const World<T> world = randomWorld<T>(random, 1 + random() % 5000);
        const auto sorted = world.sorted();
        const ValueBuckets<T> buckets(world.field, world.missing, world.kept, kSmall);
        const auto& begin = buckets.about().begin;
        ASSERT_EQ(begin.back(), sorted.size());
        const std::size_t all = buckets.about().least.size();
        for (std::size_t first = 0, end; first < all; first = end) {
            end = std::min<std::size_t>(all, first + 1 + random() % 4);
            const LazyColumn<T> part(buckets.points(first, end), kSmall.threads);
            part.orderAll();
            const std::vector<std::uint32_t> cut(
                sorted.begin() + static_cast<std::ptrdiff_t>(begin[first]),
                sorted.begin() + static_cast<std::ptrdiff_t>(begin[end]));
            ASSERT_EQ(part.size(), cut.size()) << "buckets " << first << " to " << end;
            ASSERT_NO_FATAL_FAILURE(expectInOrder(part, world, cut, {0, cut.size()}));
        }
    }
}

TYPED_TEST(ValueBucketsOf, ValuesWithinAreThoseThatCompareSo) {
    using T = TypeParam;
    std::mt19937_64 random(61);
    for (int round = 0; round < 300; ++round) {
        const World<T> world = randomWorld<T>(random, 1 + random() % kWithinAtOnce);
        const T a = boundOf(world, random), b = boundOf(world, random);
        const Interval<T> in{std::min(a, b), std::max(a, b)};
        PlacesWithin<T> places;
        const std::size_t found = valuesWithin<T>(world.field, in, places);
        std::vector<OrderedKey<T>> expected;
        for (std::size_t i = 0; i < world.field.size(); ++i)
            if (in.lo <= world.field[i] && world.field[i] <= in.hi)
                expected.push_back(static_cast<OrderedKey<T>>(i));
        ASSERT_EQ(std::vector(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(found)),
                  expected);
    }
}

// One prefix of 16 bits: floats within 2^-7 of each other, and doubles within 2^-30.
TEST(Partition, CrowdedPrefixesAreDividedToo) {
    const auto largest = [](const auto& partition) {
        std::uint64_t most = 0;
        for (std::size_t b = 0; b + 1 < partition.begin.size(); ++b)
            most = std::max(most, partition.begin[b + 1] - partition.begin[b]);
        return most;
    };
    const std::vector<bool> none;
    std::mt19937_64 random(53);
    std::vector<float> floats(100000);
    std::vector<double> doubles(100000);
    for (float& v : floats) v = 1 + 0x1p-8f * static_cast<float>(random() % 100000) * 1e-5f;
    for (double& v : doubles) v = 1 + 0x1p-30 * static_cast<double>(random() % 100000) * 1e-5;
    const PartitionSize size{.threads = 2, .bucket = 2000, .worthAThread = 1000, .least = 0};
    const auto all = RangeSet::everything();
    // Even ones, and a sample of 2^14 tells their density to a tenth: 330 of them a bucket.
    EXPECT_LE(largest(partition<float>(floats, none, all.toIntervals<float>(), size)), 3000u);
    EXPECT_LE(largest(partition<double>(doubles, none, all.toIntervals<double>(), size)), 3000u);
}

}  // namespace
}  // namespace timeseries
