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
using tests::ranges::kTwo60;

template <typename T>
class SortedStepOf : public testing::Test {};
TYPED_TEST_SUITE(SortedStepOf, ValueTypes);

TYPED_TEST(SortedStepOf, EveryRangeOfAwkwardBoundsSelectsExactly) {
    using T = TypeParam;
    // Each awkward value twice, backwards the second time, one of them missing.
    std::vector<T> values = withNan(oracle::awkwardValues<T>());
    const std::size_t once = values.size();
    for (std::size_t i = 0; i < once; ++i) values.push_back(values[once - 1 - i]);
    std::vector<bool> missing(values.size());
    for (std::size_t i = 0; i < values.size(); i += 7) missing[i] = true;
    const Field field = fieldOf(values, missing);
    const SortedStep step = SortedStep::build(field);
    ASSERT_NO_FATAL_FAILURE(expectSorted<T>(step, field));
    ASSERT_NO_FATAL_FAILURE(expectStatistics<T>(step, field));
    std::vector<Number> bounds = oracle::awkwardNumbers();
    bounds.push_back(std::numeric_limits<double>::quiet_NaN());
    for (const Number& lo : bounds)
        for (const Number& hi : bounds)
            for (int ends = 0; ends < 4; ++ends)
                ASSERT_NO_FATAL_FAILURE(expectSelects<T>(
                    step, field, rangeOf({lo, (ends & 1) != 0}, {hi, (ends & 2) != 0})));
}

TYPED_TEST(SortedStepOf, RandomFieldsSelectExactly) {
    using T = TypeParam;
    std::mt19937_64 random(31);
    for (int i = 0; i < 400; ++i) {
        const Field field = randomField<T>(random, 1 + random() % 200);
        SCOPED_TRACE("case " + std::to_string(i) + " " + describe<T>(field));
        const SortedStep step = SortedStep::build(field);
        ASSERT_NO_FATAL_FAILURE(expectSorted<T>(step, field));
        ASSERT_NO_FATAL_FAILURE(expectStatistics<T>(step, field));
        const std::vector<Number> bounds = boundsFor<T>(field);
        for (int k = 0; k < 20; ++k)
            ASSERT_NO_FATAL_FAILURE(
                expectSelects<T>(step, field, RangeSet(oracle::randomRanges(random, 6, bounds))));
    }
}

TYPED_TEST(SortedStepOf, SmallSizesSortOneByOne) {
    using T = TypeParam;
    std::mt19937_64 random(33);
    for (std::size_t n = 1; n <= 300; ++n) {
        std::vector<T> values(n);
        for (T& value : values) value = randomValue<T>(random);
        const Field field = fieldOf(std::move(values));
        ASSERT_NO_FATAL_FAILURE(expectSorted<T>(SortedStep::build(field), field)) << n;
    }
}

TYPED_TEST(SortedStepOf, LargeFieldsSortWithTiesByGridIndex) {
    using T = TypeParam;
    std::mt19937_64 random(34);
    for (std::uint64_t distinct :
         {std::uint64_t{1}, std::uint64_t{3}, std::uint64_t{100}, ~std::uint64_t{0}}) {
        std::vector<T> values(70001);
        for (T& value : values) {
            if (distinct == ~std::uint64_t{0}) value = randomValue<T>(random);
            if (distinct != ~std::uint64_t{0}) value = static_cast<T>(random() % distinct);
        }
        const Field field = fieldOf(std::move(values));
        const SortedStep step = SortedStep::build(field);
        ASSERT_NO_FATAL_FAILURE(expectSorted<T>(step, field)) << distinct;
        ASSERT_NO_FATAL_FAILURE(expectStatistics<T>(step, field)) << distinct;
    }
}

TYPED_TEST(SortedStepOf, AllMissingIsEmptyAndStillAnswers) {
    using T = TypeParam;
    const Field field = fieldOf(std::vector<T>(5, T{1}), std::vector<bool>(5, true));
    const SortedStep step = SortedStep::build(field);
    EXPECT_EQ(step.size(), 0U);
    EXPECT_EQ(step.statistics().points, 0U);
    EXPECT_EQ(step.statistics().missing, 5U);
    EXPECT_TRUE(std::isnan(toDouble(step.statistics().min)));
    EXPECT_TRUE(std::isnan(toDouble(step.statistics().max)));
    EXPECT_TRUE(step.select(RangeSet::everything()).empty());
    EXPECT_EQ(step.count(RangeSet::everything()), 0U);
    EXPECT_TRUE(step.quantiles(5).empty());
    EXPECT_EQ(step.type(), field.type());
}

TYPED_TEST(SortedStepOf, ASinglePointIsSelectedByItsValueOnly) {
    using T = TypeParam;
    for (T value : oracle::awkwardValues<T>()) {
        const Field field = fieldOf(std::vector<T>{value});
        const SortedStep step = SortedStep::build(field);
        ASSERT_NO_FATAL_FAILURE(expectStatistics<T>(step, field));
        for (T at : {oracle::neighbour(value, -1), value, oracle::neighbour(value, 1)}) {
            const Number number = std::is_floating_point_v<T> ? Number(static_cast<double>(at))
                                  : std::is_signed_v<T> ? Number(static_cast<std::int64_t>(at))
                                                        : Number(static_cast<std::uint64_t>(at));
            const RangeSet only({closed(number, number)});
            const Runs expected = at == value ? Runs{{0, 1}} : Runs{};
            ASSERT_EQ(step.select(only), expected) << describe(only.ranges());
        }
    }
}

TYPED_TEST(SortedStepOf, AConstantFieldIsAllOrNothing) {
    using T = TypeParam;
    const Field field = fieldOf(std::vector<T>(1000, T{7}));
    const SortedStep step = SortedStep::build(field);
    EXPECT_EQ(step.select(RangeSet({closed(7.0, 7.0)})), (Runs{{0, 1000}}));
    EXPECT_TRUE(step.select(rangeOf({7.0, true}, {9.0, false})).empty());
    EXPECT_TRUE(step.select(rangeOf({5.0, false}, {7.0, true})).empty());
    EXPECT_THAT(step.quantiles(4), testing::Each(7.0));
}

TYPED_TEST(SortedStepOf, EverythingIsOneRunOfAllValidPoints) {
    using T = TypeParam;
    std::mt19937_64 random(35);
    for (int i = 0; i < 100; ++i) {
        const Field field = randomField<T>(random, 1 + random() % 300);
        SCOPED_TRACE(describe<T>(field));
        const SortedStep step = SortedStep::build(field);
        ASSERT_EQ(step.size(), step.statistics().points);
        ASSERT_EQ(step.count(RangeSet::everything()), step.size());
        ASSERT_EQ(step.select(RangeSet::everything()).size(), step.size() > 0 ? 1U : 0U);
    }
}

TYPED_TEST(SortedStepOf, ValueStatesThePointExactly) {
    using T = TypeParam;
    const Field field = fieldOf(oracle::awkwardValues<T>());
    const SortedStep step = SortedStep::build(field);
    for (std::uint64_t point = 0; point < step.size(); ++point)
        ASSERT_EQ(oracle::real(step.value(point)),
                  static_cast<oracle::Real>(valuesIn<T>(field)[step.gridIndex()[point]]));
}

TEST(SortedStep, NanAndMissingAreNeverSelected) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const SortedStep step = SortedStep::build(
        fieldOf<float>({nan, 3, 1, -nan, 2, 1}, {false, true, false, false, false, false}));
    EXPECT_EQ(step.statistics().points, 3U);
    EXPECT_EQ(step.statistics().missing, 3U);
    EXPECT_THAT(step.gridIndex(), testing::ElementsAre(2, 5, 4));
    EXPECT_EQ(step.count(RangeSet::everything()), 3U);
}

TEST(SortedStep, PermutingNanPayloadsChangesNothing) {
    // Every NaN, signalling or not, of either sign: the order of the others must not see them.
    std::vector<double> values{4, 0, 2, 0, 1, 0, 3};
    std::vector<SortedStep> steps;
    for (const std::uint64_t payload :
         {0x7ff8000000000000U, 0xfff8000000000000U, 0x7ff0000000000001U, 0xffffffffffffffffU}) {
        for (std::size_t i : {1, 3, 5}) values[i] = std::bit_cast<double>(payload);
        steps.push_back(SortedStep::build(fieldOf(values)));
    }
    for (const SortedStep& step : steps)
        EXPECT_THAT(step.gridIndex(), testing::ElementsAre(4, 2, 6, 0));
}

TEST(SortedStep, InfinitiesAreValuesAtTheEnds) {
    const float infinity = std::numeric_limits<float>::infinity();
    const SortedStep step = SortedStep::build(fieldOf<float>({infinity, 0, -infinity, 1}));
    EXPECT_THAT(step.gridIndex(), testing::ElementsAre(2, 1, 3, 0));
    EXPECT_EQ(toDouble(step.statistics().min), -kInfinity);
    EXPECT_EQ(toDouble(step.statistics().max), kInfinity);
    EXPECT_EQ(step.count(rangeOf({-kInfinity, true}, {kInfinity, true})), 2U);
    EXPECT_EQ(step.count(RangeSet({closed(kInfinity, kInfinity)})), 1U);
    EXPECT_EQ(step.count(RangeSet({closed(-1e300, 1e300)})), 2U);
    EXPECT_EQ(step.count(RangeSet({closed(1e300, kInfinity)})), 1U);
}

TEST(SortedStep, BothZerosAreOneValueInOrderOfGridIndex) {
    const SortedStep step =
        SortedStep::build(fieldOf<double>({0.0, -0.0, 5e-324, -0.0, 0.0, -5e-324}));
    EXPECT_THAT(step.gridIndex(), testing::ElementsAre(5, 0, 1, 3, 4, 2));
    for (double lo : {0.0, -0.0})
        for (double hi : {0.0, -0.0})
            EXPECT_EQ(step.select(RangeSet({closed(lo, hi)})), (Runs{{1, 4}}));
}

TEST(SortedStep, DenormalsAreNotZero) {
    const float tiny = std::numeric_limits<float>::denorm_min();
    const SortedStep step = SortedStep::build(fieldOf<float>({tiny, 0, -tiny}));
    EXPECT_THAT(step.gridIndex(), testing::ElementsAre(2, 1, 0));
    EXPECT_EQ(step.select(rangeOf({0.0, true}, {1.0, false})), (Runs{{2, 1}}));
    EXPECT_EQ(step.select(rangeOf({-1.0, false}, {0.0, true})), (Runs{{0, 1}}));
}

TEST(SortedStep, NeighboursOfTwoToTheSixtyAreTold) {
    const SortedStep step =
        SortedStep::build(fieldOf<std::int64_t>({kTwo60 + 1, kTwo60, kTwo60 - 1}));
    EXPECT_EQ(step.count(RangeSet({closed(kTwo60, kTwo60)})), 1U);
    EXPECT_EQ(step.count(RangeSet({closed(kTwo60 + 1, kTwo60 + 1)})), 1U);
    EXPECT_EQ(step.count(rangeOf({0x1p60, true}, {kInfinity, false})), 1U);
    EXPECT_EQ(step.count(RangeSet::parse("1152921504606846977")), 1U);
    EXPECT_TRUE(compare(step.value(2), kTwo60 + 1) == 0);
}

TEST(SortedStep, AdjacentRangesBecomeOneRun) {
    const SortedStep step = SortedStep::build(fieldOf<float>({0, 1, 2, 3, 4}));
    EXPECT_EQ(step.select(RangeSet::parse("[0,2),[2,3]")), (Runs{{0, 4}}));
    EXPECT_EQ(step.select(RangeSet::parse("[0,2),(2,3]")), (Runs{{0, 2}, {3, 1}}));
    // They touch only in float.
    EXPECT_EQ(step.select(RangeSet({closed(0.0, 1.0), {{1 + 1e-12, true}, {2.0, false}}})),
              (Runs{{0, 3}}));
}

TEST(SortedStep, SharesTheFieldsGrid) {
    const Field field = fieldOf<float>({1, 2});
    const SortedStep step = SortedStep::build(field);
    EXPECT_EQ(step.sharedGrid(), field.grid);
    EXPECT_EQ(&step.grid(), field.grid.get());
}

}  // namespace
}  // namespace timeseries
