// Sets of ranges in the types of fields: bounds are rounded once, and a union holds what its parts
// hold.
#include "timeseries/index/range_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/canonical_ranges.h"
#include "tests/support/ranges.h"
#include "tests/support/rounds.h"

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

template <typename T>
class RangeSetIn : public testing::Test {};
using ValueTypes =
    testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                   std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(RangeSetIn, ValueTypes);

template <typename T>
bool intervalHolds(std::span<const Interval<T>> intervals, T v) {
    for (const Interval<T>& interval : intervals)
        if (interval.lo <= v && v <= interval.hi) return true;
    return false;
}

// Values of T around every awkward number.
template <typename T>
std::vector<T> values() {
    std::vector<T> all = oracle::awkwardValues<T>();
    for (const Number& number : oracle::awkwardNumbers()) oracle::addNear<T>(number, all);
    return all;
}

TYPED_TEST(RangeSetIn, EveryRangeOfAwkwardBoundsConvertsExactly) {
    using T = TypeParam;
    std::vector<Number> numbers = oracle::awkwardNumbers();
    numbers.push_back(std::numeric_limits<double>::quiet_NaN());
    const std::vector<T> all = values<T>();
    constexpr std::size_t kEach = tests::kSanitized ? 5 : 1;
    for (std::size_t i = 0; i < numbers.size(); i += kEach)
        for (const Number& hi : numbers)
            for (int ends = 0; ends < 4; ++ends) {
                const Range range{{numbers[i], (ends & 1) != 0}, {hi, (ends & 2) != 0}};
                Interval<T> interval{};
                const bool found = toInterval(range, interval);
                ASSERT_TRUE(!found || interval.lo <= interval.hi) << describe(range);
                bool any = false;
                for (T v : all) {
                    const bool expected = oracle::holds(range, v);
                    any = any || expected;
                    ASSERT_EQ(found && interval.lo <= v && v <= interval.hi, expected)
                        << describe(range) << " at " << static_cast<Real>(v);
                }
                ASSERT_EQ(found, any) << describe(range);
            }
}

TYPED_TEST(RangeSetIn, RandomSetsBecomeAscendingIntervalsWithGaps) {
    using T = TypeParam;
    const std::vector<Number> numbers = oracle::awkwardNumbers();
    const std::vector<T> all = values<T>();
    std::mt19937_64 random(23);
    for (int i = 0; i < 2000; ++i) {
        const RangeSet set(oracle::randomRanges(random, 7, numbers));
        const std::vector<Interval<T>> intervals = set.toIntervals<T>();
        SCOPED_TRACE("case " + std::to_string(i) + " " + describe(set.ranges()));
        for (std::size_t k = 0; k < intervals.size(); ++k) {
            ASSERT_LE(intervals[k].lo, intervals[k].hi);
            if (k == 0) continue;
            ASSERT_LT(intervals[k - 1].hi, intervals[k].lo);
            ASSERT_LT(oracle::neighbour(intervals[k - 1].hi, 1), intervals[k].lo);
        }
        for (T v : all)
            ASSERT_EQ(intervalHolds<T>(intervals, v), oracle::holds<T>(set.ranges(), v))
                << static_cast<Real>(v);
    }
}

TYPED_TEST(RangeSetIn, EverythingIsOneIntervalFromEndToEnd) {
    using T = TypeParam;
    using L = std::numeric_limits<T>;
    const std::vector<Interval<T>> all = RangeSet::everything().toIntervals<T>();
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].lo, L::has_infinity ? -L::infinity() : L::lowest());
    EXPECT_EQ(all[0].hi, L::has_infinity ? L::infinity() : L::max());
}

// Bounds around a value of T, most of which T rounds to it or to a neighbour.
template <typename T>
std::vector<Number> nearlySame(T value) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    std::vector<Number> numbers;
    for (const T each : {oracle::neighbour(value, -1), value, oracle::neighbour(value, 1)}) {
        const Real x = static_cast<Real>(each);
        if (std::fabs(x) > static_cast<Real>(std::numeric_limits<double>::max())) continue;
        const double d = static_cast<double>(x);
        for (const double nearby :
             {d, std::nextafter(d, kInf), std::nextafter(d, -kInf), d + 0.25, d - 0.25})
            numbers.push_back(nearby);
        const T next = oracle::neighbour(each, 1);
        const double half = static_cast<double>(x + (static_cast<Real>(next) - x) / 2);
        for (const double nearby : {half, std::nextafter(half, kInf), std::nextafter(half, -kInf)})
            numbers.push_back(nearby);
        for (const int off : {-1, 0, 1}) {
            const Real whole = std::floor(x) + off;
            if (whole >= -0x1p63L && whole < 0x1p63L)
                numbers.push_back(static_cast<std::int64_t>(whole));
            if (whole >= 0 && whole < 0x1p64L) numbers.push_back(static_cast<std::uint64_t>(whole));
        }
    }
    return numbers;
}

TYPED_TEST(RangeSetIn, AUnionHoldsWhatAnyPartHolds) {
    using T = TypeParam;
    std::vector<T> centres = oracle::awkwardValues<T>();
    std::erase_if(centres, [](T v) { return std::isinf(static_cast<Real>(v)); });
    centres.push_back(static_cast<T>(100));
    if (std::is_floating_point_v<T>) centres.push_back(static_cast<T>(273.15));
    std::mt19937_64 random(24);
    for (int i = 0; i < 3000; ++i) {
        const T centre = centres[random() % centres.size()];
        std::vector<Number> numbers = nearlySame(centre);
        numbers.insert(numbers.end(), {-kInfinity, kInfinity, 250.0});
        const std::vector<Range> parts = oracle::randomRanges(random, 5, numbers);
        std::vector<RangeSet> sets;
        for (const Range& part : parts) sets.push_back(RangeSet({part}));
        const RangeSet all = unionOf(sets);
        SCOPED_TRACE("case " + std::to_string(i) + " " + describe(parts) + " became " +
                     describe(all.ranges()));
        ASSERT_TRUE(canonical(all.ranges()));
        const std::vector<Interval<T>> intervals = all.toIntervals<T>();
        for (std::size_t k = 1; k < intervals.size(); ++k)
            ASSERT_LT(oracle::neighbour(intervals[k - 1].hi, 1), intervals[k].lo);
        std::vector<T> values;
        for (const Number& number : numbers) oracle::addNear<T>(number, values);
        for (const T v : values)
            ASSERT_EQ(intervalHolds<T>(intervals, v), oracle::holds<T>(parts, v))
                << static_cast<Real>(v);
        if (all.empty()) continue;
        ASSERT_EQ(RangeSet::parse(all.text()), all) << all.text();
        ASSERT_EQ(RangeSet::parse(all.text()).toIntervals<T>(), intervals) << all.text();
    }
}

// Ranges of the same low end stay apart where rounding tells them apart: their order too is that of
// the set.
TEST(RangeSetConversion, TheOrderInWhichRangesAreGivenDoesNotMatter) {
    const std::vector<Number> numbers{250.0, 273.149999, 273.15, std::nextafter(273.15, 0.0),
                                      static_cast<double>(static_cast<float>(273.15))};
    std::mt19937_64 random(25);
    for (int i = 0; i < 2000; ++i) {
        std::vector<Range> parts = oracle::randomRanges(random, 4, numbers);
        const RangeSet set(parts);
        SCOPED_TRACE("case " + std::to_string(i) + " " + describe(parts));
        std::ranges::shuffle(parts, random);
        ASSERT_EQ(RangeSet(parts), set) << describe(RangeSet(parts).ranges());
    }
    EXPECT_EQ(RangeSet({halfOpen(250.0, 273.15), closed(250.0, 273.149999)}).text(),
              "250:273.149999,[250,273.15)")
        << "by their high ends where the low ones are the same";
}

// The float below 273.15 ends the first range; 273.149999 is rounded to the one that it leaves out.
TEST(RangeSetConversion, ARangeThatEndsSoonerMayEndLaterInFloat) {
    const RangeSet first({halfOpen(250.0, 273.15)}), second({closed(260.0, 273.149999)});
    const float last = static_cast<float>(273.15);
    ASSERT_EQ(static_cast<float>(273.149999), last);
    const RangeSet both = unionOf(std::vector{first, second});
    EXPECT_EQ(both.toIntervals<float>(), (std::vector<Interval<float>>{{250, last}}));
    EXPECT_EQ(both.toIntervals<double>(), first.toIntervals<double>());
    EXPECT_EQ(both.text(), "[250,273.15),260:273.149999");
}

// The float at 2 is in neither part, though the parts overlap by 1e-9.
TEST(RangeSetConversion, AValueThatBothPartsLeaveOutStaysOut) {
    const RangeSet both({halfOpen(1.0, 2.0), openLow(2 - 1e-9, 3.0)});
    EXPECT_EQ(both.toIntervals<float>(),
              (std::vector<Interval<float>>{{1, std::nextafter(2.0F, 1.0F)},
                                            {std::nextafter(2.0F, 3.0F), 3}}));
    EXPECT_EQ(both.toIntervals<double>().size(), 1U);
}

TEST(RangeSetConversion, RangesThatMeetOnlyInFloatBecomeOne) {
    const RangeSet set({closed(0.0, 1.0), openLow(1 + 1e-12, 2.0)});
    ASSERT_EQ(set.ranges().size(), 2U);
    EXPECT_EQ(set.toIntervals<float>(), (std::vector<Interval<float>>{{0, 2}}));
    EXPECT_EQ(set.toIntervals<double>().size(), 2U);
}

TEST(RangeSetConversion, RangesThatOverlapOnlyInFloatBecomeOne) {
    const RangeSet set({closed(0.0, 1 + 1e-9), closed(1 + 2e-9, 2.0)});
    EXPECT_EQ(set.toIntervals<float>(), (std::vector<Interval<float>>{{0, 2}}));
}

TEST(RangeSetConversion, IntegerNeighboursAreAdjacent) {
    EXPECT_EQ(RangeSet({closed(1_i, 2_i), closed(3_i, 4_i)}).toIntervals<std::int32_t>(),
              (std::vector<Interval<std::int32_t>>{{1, 4}}));
    EXPECT_EQ(RangeSet({closed(1_i, 2_i), closed(4_i, 5_i)}).toIntervals<std::int32_t>(),
              (std::vector<Interval<std::int32_t>>{{1, 2}, {4, 5}}));
    EXPECT_EQ(RangeSet({halfOpen(1.0, 2.5), openLow(2.5, 4.0)}).toIntervals<std::int32_t>(),
              (std::vector<Interval<std::int32_t>>{{1, 4}}));
}

TEST(RangeSetConversion, OpenAndClosedEndsOfFractionsAreTheSameInIntegers) {
    for (const Range& range : {closed(0.5, 3.5), open(0.5, 3.5), open(0.0, 4.0), closed(1.0, 3.0)})
        EXPECT_EQ(RangeSet({range}).toIntervals<std::uint8_t>(),
                  (std::vector<Interval<std::uint8_t>>{{1, 3}}))
            << describe(range);
}

TEST(RangeSetConversion, IntegersAreRoundedToFloatOnce) {
    // Floats near 2^60 are 2^37 apart. Just above the half the nearest is the upper one; a double
    // on the way would land on the half itself, and that goes to the even lower one.
    const std::int64_t aboveHalf = kTwo60 + (std::int64_t{1} << 36) + 1;
    EXPECT_EQ(RangeSet({closed(aboveHalf, aboveHalf)}).toIntervals<float>(),
              (std::vector<Interval<float>>{{0x1p60F + 0x1p37F, 0x1p60F + 0x1p37F}}));
}

TEST(RangeSetConversion, NeighboursOfTwoToTheSixtyAreSeparate) {
    EXPECT_EQ(RangeSet({closed(kTwo60 + 1, kTwo60 + 1)}).toIntervals<std::int64_t>(),
              (std::vector<Interval<std::int64_t>>{{kTwo60 + 1, kTwo60 + 1}}));
    EXPECT_EQ(RangeSet({openLow(0x1p60, kTwo60 + 1)}).toIntervals<std::int64_t>(),
              (std::vector<Interval<std::int64_t>>{{kTwo60 + 1, kTwo60 + 1}}));
    EXPECT_TRUE(RangeSet({open(kTwo60, kTwo60 + 1)}).toIntervals<std::int64_t>().empty());
}

TEST(RangeSetConversion, ClosedZeroHoldsBothZerosAndOpenNeither) {
    for (double zero : {0.0, -0.0}) {
        const auto at = RangeSet({closed(zero, zero)}).toIntervals<float>();
        ASSERT_EQ(at.size(), 1U);
        EXPECT_TRUE(intervalHolds<float>(at, -0.0F) && intervalHolds<float>(at, 0.0F));
        const auto above = RangeSet({openLow(zero, 1.0)}).toIntervals<float>();
        ASSERT_EQ(above.size(), 1U);
        EXPECT_EQ(above[0].lo, std::numeric_limits<float>::denorm_min());
        const auto below = RangeSet({halfOpen(-1.0, zero)}).toIntervals<float>();
        ASSERT_EQ(below.size(), 1U);
        EXPECT_EQ(below[0].hi, -std::numeric_limits<float>::denorm_min());
    }
}

TEST(RangeSetConversion, FiniteBoundsBeyondFloatStayOutside) {
    using F = std::numeric_limits<float>;
    EXPECT_EQ(RangeSet({closed(-1e300, 1e300)}).toIntervals<float>(),
              (std::vector<Interval<float>>{{F::lowest(), F::max()}}));
    EXPECT_EQ(RangeSet({open(-1e300, 1e300)}).toIntervals<float>(),
              (std::vector<Interval<float>>{{F::lowest(), F::max()}}));
    EXPECT_EQ(RangeSet({closed(1e300, kInfinity)}).toIntervals<float>(),
              (std::vector<Interval<float>>{{F::infinity(), F::infinity()}}));
    EXPECT_TRUE(RangeSet({closed(1e299, 1e300)}).toIntervals<float>().empty());
}

// As NumPy prints it, a little above: (2 - 2^-23) 2^127 is 3.40282346638528859...e38.
TEST(RangeSetConversion, TheLargestFloatInItsShortestDigitsIsIt) {
    using F = std::numeric_limits<float>;
    ASSERT_GT(3.4028235e38, double(F::max()));
    EXPECT_EQ(RangeSet({closed(3.4028235e38, kInfinity)}).toIntervals<float>(),
              (std::vector<Interval<float>>{{F::max(), F::infinity()}}));
    EXPECT_EQ(RangeSet({closed(-kInfinity, -3.4028235e38)}).toIntervals<float>(),
              (std::vector<Interval<float>>{{-F::infinity(), F::lowest()}}));
    EXPECT_EQ(RangeSet({open(-3.4028235e38, 3.4028235e38)}).toIntervals<float>(),
              (std::vector<Interval<float>>{
                  {std::nextafter(F::lowest(), 0.0f), std::nextafter(F::max(), 0.0f)}}));
}

}  // namespace
}  // namespace timeseries
