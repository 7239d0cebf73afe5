#include "timeseries/index/sorted_step.h"
#include "tests/support/ranges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "tests/support/selection_oracle.h"

namespace timeseries {
namespace {

using oracle::describe;
using tests::ranges::kTwo60;
using Indices = std::vector<std::uint32_t>;
using Runs = std::vector<Run>;  // inside a test, Run is gtest's

Range closed(Number lo, Number hi) { return {{lo, false}, {hi, false}}; }
RangeSet rangeOf(Bound lo, Bound hi) { return RangeSet(std::vector<Range>{{lo, hi}}); }

std::shared_ptr<const Grid> lineOf(std::size_t n) {
    Axis x{"x", "index", std::vector<double>(n)};
    std::iota(x.coordinates.begin(), x.coordinates.end(), 0.0);
    return std::make_shared<const Grid>(
        std::array<Axis, 3>{std::move(x), Axis{"y", "index", {0.0}}, Axis{"z", "index", {0.0}}});
}

template <typename T>
Field fieldOf(std::vector<T> values, std::vector<bool> missing = {}) {
    auto grid = lineOf(values.size());
    return {std::move(grid), std::move(values), std::move(missing)};
}

template <typename T>
const std::vector<T>& valuesIn(const Field& field) {
    return std::get<std::vector<T>>(field.values);
}

template <typename T>
bool valid(const Field& field, std::size_t i) {
    const T value = valuesIn<T>(field)[i];
    return (field.missing.empty() || !field.missing[i]) && value == value;
}

// Every point of the field that the ranges hold, ascending by grid index.
template <typename T>
Indices expectedPoints(const Field& field, std::span<const Range> ranges) {
    Indices points;
    for (std::size_t i = 0; i < valuesIn<T>(field).size(); ++i)
        if (valid<T>(field, i) && oracle::holds(ranges, valuesIn<T>(field)[i]))
            points.push_back(static_cast<std::uint32_t>(i));
    return points;
}

// Grid indices of all points in the runs, ascending; also checks that the runs are as promised.
Indices pointsOf(const SortedStep& step, std::span<const Run> runs) {
    Indices points;
    std::uint64_t end = 0;
    for (const Run& run : runs) {
        EXPECT_GT(run.count, 0U);
        EXPECT_GE(run.first, end);
        end = run.first + run.count;
        EXPECT_LE(end, step.size());
        if (testing::Test::HasFailure()) return {};
        const auto indices = step.gridIndex().subspan(run.first, run.count);
        points.insert(points.end(), indices.begin(), indices.end());
    }
    std::sort(points.begin(), points.end());
    return points;
}

template <typename T>
void expectSelects(const SortedStep& step, const Field& field, const RangeSet& ranges) {
    const Indices expected = expectedPoints<T>(field, ranges.ranges());
    ASSERT_EQ(pointsOf(step, step.select(ranges)), expected) << describe(ranges.ranges());
    ASSERT_EQ(step.count(ranges), expected.size()) << describe(ranges.ranges());
}

// All that is promised of a step but selection: points, order, ties, statistics, memory.
template <typename T>
void expectSorted(const SortedStep& step, const Field& field) {
    const auto& given = valuesIn<T>(field);
    const auto sorted = std::get<std::span<const T>>(step.columns().values);
    Indices expected = expectedPoints<T>(field, step.kept().ranges());
    std::stable_sort(expected.begin(), expected.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return given[a] < given[b]; });
    ASSERT_EQ(step.type(), field.type());
    ASSERT_EQ(step.size(), expected.size());
    ASSERT_EQ(sorted.size(), expected.size());
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), step.gridIndex().begin()));
    for (std::size_t k = 0; k < expected.size(); ++k)
        ASSERT_EQ(sorted[k], given[expected[k]]) << "at " << k;
    // Vectors' own slots, the kept ranges and the statistics; 16 bytes a bound and its tag.
    std::size_t constant = sizeof(SortedStep) + 128 * (step.kept().ranges().size() + 1);
    // Where each starts, of each value that there is.
    if (sizeof(T) <= 2) constant += 16 * std::set<T>(sorted.begin(), sorted.end()).size();
    ASSERT_GE(step.bytes(), (sizeof(T) + 4) * expected.size());
    ASSERT_LE(step.bytes(), (sizeof(T) + 4) * expected.size() + constant);
}

template <typename T>
void expectStatistics(const SortedStep& step, const Field& field) {
    const auto& given = valuesIn<T>(field);
    std::vector<T> all;
    for (std::size_t i = 0; i < given.size(); ++i)
        if (valid<T>(field, i)) all.push_back(given[i]);
    const StepStatistics& statistics = step.statistics();
    ASSERT_EQ(statistics.points, all.size());
    ASSERT_EQ(statistics.missing, given.size() - all.size());
    if (all.empty()) {
        ASSERT_TRUE(std::isnan(toDouble(statistics.min)));
        ASSERT_TRUE(std::isnan(toDouble(statistics.max)));
        return;
    }
    ASSERT_EQ(oracle::real(statistics.min), *std::min_element(all.begin(), all.end()));
    ASSERT_EQ(oracle::real(statistics.max), *std::max_element(all.begin(), all.end()));
    std::erase_if(all, [](T value) { return std::isinf(static_cast<oracle::Real>(value)); });
    if (all.empty()) {
        ASSERT_TRUE(std::isnan(toDouble(statistics.finiteMin)));
        ASSERT_TRUE(std::isnan(toDouble(statistics.finiteMax)));
        return;
    }
    ASSERT_EQ(oracle::real(statistics.finiteMin), *std::min_element(all.begin(), all.end()));
    ASSERT_EQ(oracle::real(statistics.finiteMax), *std::max_element(all.begin(), all.end()));
}

template <typename T>
T randomValue(std::mt19937_64& random) {
    if constexpr (std::is_same_v<T, float>) {
        return std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    } else if constexpr (std::is_same_v<T, double>) {
        return std::bit_cast<double>(random());
    } else {
        return static_cast<T>(random());
    }
}

template <typename T>
std::vector<T> withNan(std::vector<T> values) {
    if constexpr (std::is_floating_point_v<T>) {
        values.push_back(std::numeric_limits<T>::quiet_NaN());
        values.push_back(-std::numeric_limits<T>::quiet_NaN());
    }
    return values;
}

// A field of n points: few awkward values (many ties), any bits, or one value; some with missing.
template <typename T>
Field randomField(std::mt19937_64& random, std::size_t n) {
    const std::vector<T> pool = withNan(oracle::awkwardValues<T>());
    const std::size_t kinds = 1 + random() % pool.size();
    const std::uint64_t shape = random() % 4;
    std::vector<T> values(n);
    for (T& value : values) {
        if (shape == 0) value = pool[random() % pool.size()];
        if (shape == 1) value = pool[random() % kinds];
        if (shape == 2) value = randomValue<T>(random);
        if (shape == 3) value = pool[kinds - 1];
    }
    std::vector<bool> missing;
    if (random() % 2 == 0) {
        missing.resize(n);
        const std::uint64_t oneIn = 1 + random() % 4;  // 1: all of them
        for (std::size_t i = 0; i < n; ++i) missing[i] = random() % oneIn == 0;
    }
    return fieldOf(std::move(values), std::move(missing));
}

template <typename T>
std::string describe(const Field& field) {
    std::ostringstream out;
    out.precision(21);
    out << typeName(field.type()) << " [";
    for (std::size_t i = 0; i < valuesIn<T>(field).size() && i < 40; ++i) {
        out << ' ' << static_cast<oracle::Real>(valuesIn<T>(field)[i]);
        if (!field.missing.empty() && field.missing[i]) out << "(missing)";
    }
    out << " ] of " << valuesIn<T>(field).size();
    return out.str();
}

// Awkward numbers, and some of the field's own values as a reader of its type would state them.
template <typename T>
std::vector<Number> boundsFor(const Field& field) {
    std::vector<Number> bounds = oracle::awkwardNumbers();
    const auto& values = valuesIn<T>(field);
    for (std::size_t i = 0; i < values.size() && i < 20; ++i) {
        bounds.push_back(static_cast<double>(values[i]));
        if constexpr (std::is_signed_v<T> && std::is_integral_v<T>)
            bounds.push_back(static_cast<std::int64_t>(values[i]));
        if constexpr (std::is_unsigned_v<T>)
            bounds.push_back(static_cast<std::uint64_t>(values[i]));
    }
    return bounds;
}

template <typename T>
class SortedStepOf : public testing::Test {};
using ValueTypes =
    testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                   std::int32_t, std::uint64_t, std::int64_t, float, double>;
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

TYPED_TEST(SortedStepOf, RandomKeptRangesDropExactlyWhatIsOutside) {
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

TYPED_TEST(SortedStepOf, TheKeptPartIsWhatBothHold) {
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

TYPED_TEST(SortedStepOf, QuantilesAreOfTheNearestRank) {
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

TYPED_TEST(SortedStepOf, QuantilesAreOfTheKeptPoints) {
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

// --- Single behaviours, by hand.

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

TEST(SortedStep, SharesTheFieldsGrid) {
    const Field field = fieldOf<float>({1, 2});
    const SortedStep step = SortedStep::build(field);
    EXPECT_EQ(step.sharedGrid(), field.grid);
    EXPECT_EQ(&step.grid(), field.grid.get());
}

}  // namespace
}  // namespace timeseries
