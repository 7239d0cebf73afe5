#include "timeseries/index/sorted_step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tests/support/sorted_fields.h"

namespace timeseries {
namespace {

using namespace tests::sorted;

template <typename T>
class KeptStepOf : public testing::Test {};
TYPED_TEST_SUITE(KeptStepOf, ValueTypes);

TYPED_TEST(KeptStepOf, RandomKeptRangesDropExactlyWhatIsOutside) {
    using T = TypeParam;
    std::mt19937_64 random(32);
    int answered = 0, refused = 0;
    for (int i = 0; i < 400; ++i) {
        const Field field = randomField<T>(random, 1 + random() % 100);
        const std::vector<Number> bounds = boundsFor<T>(field);
        const RangeSet kept(oracle::randomRanges(random, 4, bounds));
        SCOPED_TRACE("case " + std::to_string(i) + " " + describe<T>(field) + " kept " +
                     describe(kept.ranges()));
        const SortedStep step = SortedStep::build(field, kept);
        ASSERT_EQ(step.kept(), kept);
        ASSERT_NO_FATAL_FAILURE(expectSorted<T>(step, field));
        ASSERT_NO_FATAL_FAILURE(expectStatistics<T>(step, field));  // of the whole step
        ASSERT_NO_FATAL_FAILURE(expectSelects<T>(step, field, kept));
        for (int k = 0; k < 20; ++k) {
            std::vector<Range> asked = oracle::randomRanges(random, 3, bounds);
            // Half of the queries are cut out of what was kept, so that many are inside.
            if (k % 2 == 0 && !kept.empty())
                for (Range& range : asked) {
                    const Range& within = kept.ranges()[random() % kept.ranges().size()];
                    if (compare(range.lo.value, within.lo.value) <= 0) range.lo = within.lo;
                    if (compare(range.hi.value, within.hi.value) >= 0) range.hi = within.hi;
                }
            const RangeSet query(asked);
            if (oracle::inside<T>(query.ranges(), kept.ranges())) {
                ASSERT_NO_FATAL_FAILURE(expectSelects<T>(step, field, query));
                answered += !query.empty();
            } else {
                ASSERT_THROW(step.select(query), OutsideKeptError) << describe(query.ranges());
                ASSERT_THROW(step.count(query), OutsideKeptError) << describe(query.ranges());
                ++refused;
            }
        }
    }
    // The test is worth something only when both happen often.
    EXPECT_GT(answered, 500);
    EXPECT_GT(refused, 500);
}

TYPED_TEST(KeptStepOf, TheKeptPartIsWhatBothHold) {
    using T = TypeParam;
    std::mt19937_64 random(36);
    for (int i = 0; i < 300; ++i) {
        const Field field = randomField<T>(random, 1 + random() % 30);
        const std::vector<Number> bounds = boundsFor<T>(field);
        const RangeSet kept(oracle::randomRanges(random, 3, bounds)),
            asked(oracle::randomRanges(random, 3, bounds));
        const SortedStep step = SortedStep::build(field, kept);
        const RangeSet part = step.keptPart(asked);
        SCOPED_TRACE("case " + std::to_string(i) + " " + describe(asked.ranges()) + " of " +
                     describe(kept.ranges()) + " became " + describe(part.ranges()));
        std::vector<T> values;
        for (const RangeSet* set : {&kept, &asked})
            for (const Range& range : set->ranges())
                for (const Bound& bound : {range.lo, range.hi})
                    oracle::addNear<T>(bound.value, values);
        for (const T v : values)
            ASSERT_EQ(oracle::holds<T>(part.ranges(), v),
                      oracle::holds<T>(asked.ranges(), v) && oracle::holds<T>(kept.ranges(), v))
                << static_cast<oracle::Real>(v);
        ASSERT_NO_FATAL_FAILURE(expectSelects<T>(step, field, part));
    }
}

TYPED_TEST(KeptStepOf, QuantilesAreOfTheNearestRank) {
    using T = TypeParam;
    for (std::size_t n : {1, 2, 3, 10, 101}) {
        std::vector<T> ranks(n);  // the value of a point is its rank
        for (std::size_t i = 0; i < n; ++i) ranks[n - 1 - i] = static_cast<T>(i);
        const SortedStep step = SortedStep::build(fieldOf(ranks));
        for (std::size_t asked : {2, 3, 4, 7, 11, 102, 1024}) {
            const std::vector<double> quantiles = step.quantiles(asked);
            ASSERT_EQ(quantiles.size(), asked);
            for (std::size_t i = 0; i < asked; ++i) {
                const double rank =
                    static_cast<double>(i * (n - 1)) / static_cast<double>(asked - 1);
                ASSERT_LE(std::abs(quantiles[i] - rank), 0.5 + 1e-9) << i << " of " << asked;
                ASSERT_EQ(quantiles[i], std::round(quantiles[i]));
            }
        }
    }
}

TYPED_TEST(KeptStepOf, QuantilesAreOfTheKeptPoints) {
    using T = TypeParam;
    std::vector<T> ranks(100);
    std::iota(ranks.begin(), ranks.end(), T{0});
    const SortedStep step = SortedStep::build(fieldOf(ranks), RangeSet({closed(20.0, 40.0)}));
    EXPECT_EQ(step.quantiles(3), (std::vector<double>{20, 30, 40}));
}

// Infinities are no quantiles: of 2 and 7 of them around the ranks, the ranks' own are told.
TEST(SortedStep, QuantilesAreOfTheFinitePoints) {
    std::vector<double> values(101);
    std::iota(values.begin(), values.end(), 0.0);
    const SortedStep plain = SortedStep::build(fieldOf(values));
    values.insert(values.end(), 2, -kInfinity);
    values.insert(values.end(), 7, kInfinity);
    const SortedStep step = SortedStep::build(fieldOf(values));
    EXPECT_EQ(step.finite(), (timeseries::Run{2, 101}));
    EXPECT_EQ(plain.finite(), (timeseries::Run{0, 101}));
    for (const std::size_t n : {1, 2, 3, 11, 1025})
        EXPECT_EQ(step.quantiles(n), plain.quantiles(n));
    EXPECT_EQ(step.quantiles(1), std::vector{50.0}) << "the median";
    EXPECT_TRUE(step.quantiles(0).empty());
    const SortedStep none = SortedStep::build(fieldOf<float>(
        {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}));
    EXPECT_EQ(none.finite(), (timeseries::Run{1, 0}));
    EXPECT_TRUE(none.quantiles(3).empty());
}

TEST(SortedStep, AnEmptyQueryIsInsideAnythingKept) {
    const Field field = fieldOf<std::int16_t>({1, 2, 3});
    for (const RangeSet& kept : {RangeSet(), RangeSet::parse("2"), RangeSet::everything()}) {
        const SortedStep step = SortedStep::build(field, kept);
        EXPECT_TRUE(step.select(RangeSet()).empty());
        EXPECT_EQ(step.count(RangeSet()), 0U);
        // No int16 lies between 5 and 6: nothing is asked for.
        EXPECT_TRUE(step.select(RangeSet::parse("(5,6)")).empty());
    }
}

TEST(SortedStep, KeptIsComparedInTheFieldsType) {
    // As int16, [0, 3.5] is [0, 3] and (-0.5, 3.9) is the same.
    const SortedStep step =
        SortedStep::build(fieldOf<std::int16_t>({0, 3, 4}), RangeSet::parse("0:3.5"));
    EXPECT_EQ(step.count(RangeSet::parse("(-0.5,3.9)")), 2U);
    EXPECT_THROW(step.count(RangeSet::parse("0:4")), OutsideKeptError);
}

// In float, 273.149999 is the value that "below 273.15" leaves out: the part that ends sooner
// reaches further.
TEST(SortedStep, AUnionSelectsAndKeepsWhatItsPartsDo) {
    const float edge = static_cast<float>(273.15);
    const Field field =
        fieldOf<float>({249, 250, std::nextafter(edge, 0.0F), edge, std::nextafter(edge, 999.0F)});
    const RangeSet first = RangeSet::parse("[250,273.15)"),
                   second = RangeSet::parse("260:273.149999"),
                   both = unionOf(std::vector{first, second});
    const SortedStep all = SortedStep::build(field), kept = SortedStep::build(field, both);
    EXPECT_EQ(all.count(first), 2U);
    EXPECT_EQ(all.count(second), 2U);
    EXPECT_EQ(all.count(both), 3U);
    EXPECT_EQ(kept.size(), 3U);
    EXPECT_EQ(kept.count(second), 2U);
    EXPECT_EQ(kept.count(kept.keptPart(RangeSet::everything())), 3U);
}

TEST(SortedStep, TheKeptPartHasTheBoundsAsTheyAreWritten) {
    const auto part = [](const SortedStep& step, const char* asked) {
        return step.keptPart(RangeSet::parse(asked)).text();
    };
    const SortedStep floats =
        SortedStep::build(fieldOf<float>({0, 1}), RangeSet::parse("[0.1,0.7)"));
    EXPECT_EQ(part(floats, "0.3:2"), "[0.3,0.7)");
    EXPECT_EQ(part(floats, "0:0.3"), "0.1:0.3");
    EXPECT_EQ(part(floats, "0:2"), "[0.1,0.7)");
    EXPECT_EQ(part(floats, "(0.2,0.3)"), "(0.2,0.3)");
    EXPECT_EQ(part(floats, "0.7:2"), "");
    // Of bounds that are one value to the field, those that were asked for.
    const SortedStep integers =
        SortedStep::build(fieldOf<std::int16_t>({3, 7}), RangeSet::parse("2.2:7.9"));
    EXPECT_EQ(part(integers, "2.5:7.3"), "2.5:7.3");
}

TEST(SortedStep, AskingOutsideSaysWhatWasKept) {
    const RangeSet kept = RangeSet::parse("1:2,[5,7)");
    const SortedStep step = SortedStep::build(fieldOf<float>({0, 1, 5, 6, 7}), kept);
    for (const char* outside : {"0:1", "2:5", "5:7", "8", "min:max", "1:2,5:6,6.5:8"}) {
        const RangeSet query = RangeSet::parse(outside);
        try {
            step.select(query);
            ADD_FAILURE() << outside << " was answered";
        } catch (const OutsideKeptError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(kept.text())) << outside;
            EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
        }
        EXPECT_THROW(step.count(query), OutsideKeptError) << outside;
    }
    EXPECT_EQ(step.select(RangeSet::parse("5:6")), (Runs{{1, 2}}));
}

TEST(SortedStep, KeepingNothingKeepsTheStatistics) {
    const SortedStep step = SortedStep::build(fieldOf<float>({3, 1, 2}), RangeSet());
    EXPECT_EQ(step.size(), 0U);
    EXPECT_EQ(step.statistics().points, 3U);
    EXPECT_EQ(toDouble(step.statistics().min), 1);
    EXPECT_EQ(toDouble(step.statistics().max), 3);
    try {
        step.select(RangeSet::everything());
        ADD_FAILURE() << "was answered";
    } catch (const OutsideKeptError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("outside what was kept, nothing:"));
    }
}

}  // namespace
}  // namespace timeseries
