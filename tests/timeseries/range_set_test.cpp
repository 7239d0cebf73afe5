#include "timeseries/index/range_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/canonical_ranges.h"
#include "tests/support/ranges.h"

namespace timeseries {
namespace {

using oracle::canonical;
using oracle::describe;
using oracle::Real;
using tests::ranges::closed;
using tests::ranges::halfOpen;
using tests::ranges::kTwo60;
using tests::ranges::open;
using tests::ranges::openLow;
using tests::ranges::operator""_i;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kTwo53 = std::int64_t{1} << 53;

// Reals at which two sets made of these numbers can differ: the numbers and a real between any two.
std::vector<Real> probes(const std::vector<Number>& numbers) {
    std::vector<Real> reals;
    for (const Number& number : numbers) reals.push_back(oracle::real(number));
    std::sort(reals.begin(), reals.end());
    const std::size_t count = reals.size();
    for (std::size_t i = 1; i < count; ++i)
        if (std::isfinite(reals[i - 1]) && std::isfinite(reals[i]))
            reals.push_back(reals[i - 1] + (reals[i] - reals[i - 1]) / 2);
    const Real largest = std::numeric_limits<Real>::max();
    reals.insert(reals.end(), {-largest, largest});
    return reals;
}

bool anyHolds(std::span<const Range> ranges, Real x) {
    for (const Range& range : ranges)
        if (oracle::holdsReal(range, x)) return true;
    return false;
}

TEST(RangeSet, EmptyRangesAreDropped) {
    for (const Range& empty :
         {closed(2.0, 1.0), closed(1_i, -1.0), open(1.0, 1.0), halfOpen(1.0, 1_i),
          openLow(1_i, 1.0), closed(kNan, 1.0), closed(1.0, kNan), closed(kNan, kNan),
          open(-0.0, 0.0), openLow(kInfinity, kInfinity), closed(kInfinity, -kInfinity)})
        EXPECT_TRUE(RangeSet({empty}).empty()) << describe(empty);
    EXPECT_TRUE(RangeSet().empty());
    EXPECT_TRUE(RangeSet(std::vector<Range>{}).empty());
}

TEST(RangeSet, PointsAndInfinitiesAreNotEmpty) {
    for (const Range& range :
         {closed(1.0, 1.0), closed(-0.0, 0.0), closed(0.0, -0.0), closed(kInfinity, kInfinity),
          closed(-kInfinity, -kInfinity), closed(1_i, 1.0)})
        EXPECT_EQ(RangeSet({range}).ranges().size(), 1U) << describe(range);
}

TEST(RangeSet, TouchingRangesMerge) {
    EXPECT_EQ(RangeSet({halfOpen(1.0, 2.0), closed(2.0, 3.0)}), RangeSet({closed(1.0, 3.0)}));
    EXPECT_EQ(RangeSet({closed(1.0, 2.0), openLow(2.0, 3.0)}), RangeSet({closed(1.0, 3.0)}));
    EXPECT_EQ(RangeSet({openLow(2.0, 3.0), closed(1.0, 2.0)}), RangeSet({closed(1.0, 3.0)}));
}

TEST(RangeSet, AnExcludedPointKeepsRangesApart) {
    EXPECT_EQ(RangeSet({halfOpen(1.0, 2.0), openLow(2.0, 3.0)}).ranges().size(), 2U);
    EXPECT_EQ(RangeSet({halfOpen(1.0, 2.0), openLow(2.0, 3.0), closed(2_i, 2_i)}),
              RangeSet({closed(1.0, 3.0)}));
}

TEST(RangeSet, AContainedRangeDisappears) {
    EXPECT_EQ(RangeSet({closed(0.0, 9.0), open(2.0, 3.0), closed(9.0, 9.0), open(0.0, 9.0)}),
              RangeSet({closed(0.0, 9.0)}));
}

TEST(RangeSet, ManyTimesTheSameRangeIsOneRange) {
    for (const Range& range : {open(1.0, 2.0), closed(1.0, 2.0)})
        EXPECT_EQ(RangeSet(std::vector<Range>(1000, range)), RangeSet({range}));
}

TEST(RangeSet, MergesExactlyAcrossNumberTypes) {
    const std::uint64_t same = static_cast<std::uint64_t>(kTwo53) + 1;
    // 2^53 + 1 is no double: through doubles these would be [.., 2^53) and (2^53, ..].
    EXPECT_EQ(RangeSet({closed(0_i, kTwo53 + 1), openLow(same, 1e300)}).ranges().size(), 1U);
    EXPECT_EQ(RangeSet({halfOpen(0_i, kTwo53 + 1), openLow(same, 1e300)}).ranges().size(), 2U);
    EXPECT_EQ(RangeSet({halfOpen(0.0, 0x1p53), closed(kTwo53 + 1, 1e300)}).ranges().size(), 2U);
    EXPECT_EQ(RangeSet({closed(0.0, 0x1p60), closed(kTwo60 + 1, kTwo60 + 2)}).ranges().size(), 2U);
    EXPECT_EQ(RangeSet({halfOpen(0.0, 0x1p60), closed(kTwo60, kTwo60 + 2)}).ranges().size(), 1U);
    const std::uint64_t top = std::numeric_limits<std::uint64_t>::max();
    EXPECT_EQ(RangeSet({closed(0_i, top), closed(0x1p64, 1e300)}).ranges().size(), 2U);
}

TEST(RangeSet, EverythingHoldsTheInfinities) {
    const RangeSet all = RangeSet::everything();
    ASSERT_EQ(all.ranges().size(), 1U);
    for (Real x : {-static_cast<Real>(kInfinity), Real{0}, static_cast<Real>(kInfinity)})
        EXPECT_TRUE(anyHolds(all.ranges(), x));
    EXPECT_EQ(RangeSet({closed(-kInfinity, kInfinity)}), all);
}

TEST(RangeSet, EqualityIsOfTheSetNotOfItsSpelling) {
    EXPECT_EQ(RangeSet({closed(1_i, 2_i)}), RangeSet({closed(1.0, std::uint64_t{2})}));
    EXPECT_EQ(RangeSet({closed(0.0, 1.0)}), RangeSet({closed(-0.0, 1.0)}));
    EXPECT_FALSE(RangeSet({closed(1.0, 2.0)}) == RangeSet({halfOpen(1.0, 2.0)}));
    EXPECT_FALSE(RangeSet({closed(kTwo60, kTwo60)}) == RangeSet({closed(kTwo60 + 1, kTwo60 + 1)}));
    EXPECT_FALSE(RangeSet({closed(1.0, 2.0)}) == RangeSet());
}

TEST(RangeSet, RandomSetsAreCanonicalAndHoldExactlyTheirRanges) {
    const std::vector<Number> numbers = oracle::awkwardNumbers();
    std::vector<Number> withNan = numbers;
    withNan.push_back(kNan);
    const std::vector<Real> reals = probes(numbers);
    std::mt19937_64 random(21);
    for (int i = 0; i < 4000; ++i) {
        const std::vector<Range> given = oracle::randomRanges(random, 7, withNan);
        const RangeSet set(given);
        SCOPED_TRACE("case " + std::to_string(i) + " " + describe(given) + " became " +
                     describe(set.ranges()));
        ASSERT_TRUE(canonical(set.ranges()));
        for (Real x : reals) ASSERT_EQ(anyHolds(set.ranges(), x), anyHolds(given, x)) << x;
        ASSERT_EQ(RangeSet({set.ranges().begin(), set.ranges().end()}), set);
    }
}

TEST(RangeSet, RandomUnionsHoldWhatAnyMemberHolds) {
    const std::vector<Number> numbers = oracle::awkwardNumbers();
    const std::vector<Real> reals = probes(numbers);
    std::mt19937_64 random(22);
    for (int i = 0; i < 1000; ++i) {
        std::vector<RangeSet> sets(random() % 4);
        std::vector<Range> all;
        for (RangeSet& set : sets) {
            set = RangeSet(oracle::randomRanges(random, 3, numbers));
            all.insert(all.end(), set.ranges().begin(), set.ranges().end());
        }
        const RangeSet joined = unionOf(sets);
        SCOPED_TRACE("case " + std::to_string(i) + " " + describe(all) + " became " +
                     describe(joined.ranges()));
        ASSERT_TRUE(canonical(joined.ranges()));
        for (Real x : reals) ASSERT_EQ(anyHolds(joined.ranges(), x), anyHolds(all, x)) << x;
    }
    EXPECT_TRUE(unionOf({}).empty());
}

}  // namespace
}  // namespace timeseries
