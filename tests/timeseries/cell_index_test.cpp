#include "timeseries/index/cell_index.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "timeseries/index/sorted_step.h"

namespace timeseries {
namespace {

std::shared_ptr<const Grid> gridOf(std::array<std::size_t, 3> size) {
    std::array<Axis, 3> axes;
    for (std::size_t a = 0; a < 3; ++a)
        axes[a] = {"xyz"[a] + std::string(), "", indexCoordinates(size[a])};
    return std::make_shared<Grid>(axes);
}

// Waves with noise, of a type's own extent; some values missing.
template <typename T>
Field waves(std::array<std::size_t, 3> size, unsigned seed, bool gaps) {
    Field field;
    field.grid = gridOf(size);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-1, 1);
    std::vector<T> values;
    const double scale = std::is_floating_point_v<T>
                             ? 1
                             : std::min(100.0, double(std::numeric_limits<T>::max()) / 4);
    const double middle = std::is_unsigned_v<T> ? 2 * scale : 0;
    for (std::uint64_t i = 0; i < field.grid->count(); ++i) {
        const auto at = field.grid->indices(i);
        const double smooth =
            std::sin(0.3 * double(at.x)) * std::cos(0.2 * double(at.y) + 0.1 * double(at.z));
        values.push_back(static_cast<T>(middle + scale * (smooth + 0.05 * noise(random))));
        if (gaps) field.missing.push_back(random() % 7 == 0);
    }
    field.values = std::move(values);
    return field;
}

std::vector<std::uint32_t> selected(const CellIndex& index,
                                    std::vector<Interval<double>> intervals) {
    std::vector<std::uint32_t> cells;
    for (const Run& run : index.select(intervals))
        for (std::uint64_t i = 0; i < run.count; ++i) cells.push_back(index.cell(run.first + i));
    return cells;
}

// Every cell with finite corners, by looking at all of them: whether it reaches into one of these.
std::set<std::uint32_t> byLooking(const CellIndex& index,
                                  const std::vector<Interval<double>>& intervals) {
    std::set<std::uint32_t> cells;
    const glm::uvec3 n = index.size();
    for (std::uint32_t c = 0; c < n.x * n.y * n.z; ++c) {
        double lo = std::numeric_limits<double>::infinity(), hi = -lo;
        for (const double v : index.cornersOf().values(indicesOf(c, n)))
            if (!std::isnan(v)) lo = std::min(lo, v), hi = std::max(hi, v);
        for (const Interval<double>& i : intervals)
            if (lo <= i.hi && hi >= i.lo) cells.insert(c);
    }
    return cells;
}

template <typename T>
class CellIndexOf : public testing::Test {};
using Types = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                             std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(CellIndexOf, Types);

TYPED_TEST(CellIndexOf, HoldsEveryCellThatRangesReachIntoAndFewOthers) {
    for (const bool gaps : {false, true}) {
        const CellIndex index(waves<TypeParam>({19, 12, 9}, 3, gaps), 3);
        const std::set<std::uint32_t> all = byLooking(index, {{-1e300, 1e300}});
        EXPECT_EQ(index.count(), all.size());
        std::vector<double> values;
        for (const std::uint32_t c : all)
            for (const double v : index.cornersOf().values(indicesOf(c, index.size())))
                if (!std::isnan(v)) values.push_back(v);
        std::mt19937 random(4);
        std::size_t looked = 0, needed = 0;
        for (int i = 0; i < 60; ++i) {
            const auto value = [&] { return values[random() % values.size()]; };
            std::vector<Interval<double>> intervals;
            double lo = value();
            const double span = i % 3 == 0 ? 0 : std::abs(value() - lo) * (i % 3 == 1 ? 1 : 0.01);
            intervals.push_back({lo, lo + span});
            if (i % 2 == 0) intervals.push_back({lo + 2 * span, lo + 3 * span});
            std::vector<std::uint32_t> found = selected(index, intervals);
            const std::set<std::uint32_t> once(found.begin(), found.end());
            EXPECT_EQ(once.size(), found.size()) << "twice";
            const std::set<std::uint32_t> wanted = byLooking(index, intervals);
            EXPECT_TRUE(std::ranges::includes(once, wanted));
            looked += found.size();
            needed += wanted.size();
        }
        EXPECT_LE(static_cast<double>(looked), 1.4 * static_cast<double>(needed));
    }
}

// Whoever asks for little gets the same, in the same order, from less: for any intervals inside
// those that there are cells of, ends at values and between them.
TYPED_TEST(CellIndexOf, OfSomeIntervalsAloneSelectsTheSame) {
    for (const bool gaps : {false, true}) {
        const auto field = std::make_shared<const Field>(waves<TypeParam>({19, 12, 9}, 6, gaps));
        const CellIndex all(field, 2);
        std::vector<double> values =
            std::visit([](const auto& of) { return std::vector<double>(of.begin(), of.end()); },
                       field->values);
        std::mt19937 random(7);
        const auto between = [&](const Interval<double>& outer) {
            std::uniform_real_distribution<double> share(0, 1);
            double ends[2];
            for (double& end : ends)
                end = random() % 2 == 0
                          ? outer.lo + share(random) * (outer.hi - outer.lo)
                          : std::clamp(values[random() % values.size()], outer.lo, outer.hi);
            return Interval<double>{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
        };
        for (int i = 0; i < 40; ++i) {
            const auto [lo, hi] = std::ranges::minmax(values);
            std::vector<Interval<double>> among = {between({lo, hi})};
            if (i % 2 == 0) among.push_back(between({lo, hi}));
            if (i % 5 == 0) among.push_back({among[0].hi, among[0].hi});
            const CellIndex some(field, 1 + i % 3, among);
            EXPECT_LE(some.count(), all.count());
            for (const Interval<double>& outer : among)
                for (const Interval<double>& asked : {outer, between(outer)}) {
                    ASSERT_TRUE(some.holds({{asked}}));
                    EXPECT_EQ(selected(some, {asked}), selected(all, {asked}));
                    const auto mine = some.select({{asked}}), whole = all.select({{asked}});
                    EXPECT_EQ(some.halfRange(mine, 0.5), all.halfRange(whole, 0.5));
                }
            EXPECT_FALSE(some.holds({{{lo - 1, hi + 1}}}));
        }
    }
}

TEST(CellIndex, OfNothingHasNothing) {
    const CellIndex none(waves<float>({5, 4, 3}, 8, false), 2, {});
    EXPECT_EQ(none.count(), 0u);
    EXPECT_TRUE(none.holds({}));
    EXPECT_TRUE(none.select({}).empty());
    EXPECT_FALSE(none.holds({{{0, 0}}}));
}

// The first who asks decides what is made; who then asks for more has it all.
TEST(CellIndex, OfAStepIsMadeOfWhatIsAskedFor) {
    const Field field = waves<float>({17, 9, 8}, 9, false);
    for (const bool held : {false, true}) {
        const SortedStep step = held ? SortedStep::buildWithField(field) : SortedStep::build(field);
        const std::uint64_t points = step.pointBytes();
        EXPECT_EQ(step.bytes() - points, held ? field.bytes() : 0);
        EXPECT_EQ(step.sharedField()->values, field.values);
        const std::vector<Interval<double>> little = {{0.1, 0.2}};
        const auto some = step.cells(little);
        EXPECT_EQ(step.bytes() - step.pointBytes(), some->bytes());
        EXPECT_EQ(step.cellsIfMade(little), some);
        EXPECT_EQ(step.cells({{0.15, 0.2}}), some);
        EXPECT_EQ(step.cellsIfMade(), nullptr);
        EXPECT_EQ(step.sharedField(), some->sharedField());
        const auto all = step.cells({{0.1, 0.3}});
        EXPECT_EQ(step.cellsIfMade(), all);
        EXPECT_EQ(step.cellsIfMade(little), all);
        EXPECT_EQ(all->count(), CellIndex(field).count());
        EXPECT_EQ(selected(*all, little), selected(*some, little));
    }
}

// Of points there are those that were asked for; between them lies the whole field.
TEST(CellIndex, OfAStepThatKeepsAFewPointsAndItsFieldIsTheWholeFields) {
    const Field field = waves<float>({17, 9, 8}, 9, true);
    const RangeSet kept = RangeSet::parse("0.1:0.2");
    const SortedStep whole = SortedStep::build(field),
                     step = SortedStep::buildWithField(field, kept);
    EXPECT_EQ(step.size(), whole.count(kept));
    EXPECT_LT(step.size(), whole.size());
    EXPECT_EQ(step.statistics().points, whole.statistics().points);
    EXPECT_THROW(step.count(RangeSet::everything()), OutsideKeptError);
    ASSERT_TRUE(step.canHaveCells()) << step.whyNoCells();
    EXPECT_EQ(step.sharedField()->missing, field.missing);
    const std::vector<Interval<double>> little = {{0.1, 0.2}};
    EXPECT_EQ(selected(*step.cells(little), little), selected(*whole.cells(), little));
    EXPECT_TRUE(step.canHaveCells());
    EXPECT_EQ(SortedStep::build(field, kept).whyNoCells(), "cells need every value kept");
    const SortedStep line = SortedStep::buildWithField(waves<float>({17, 1, 1}, 9, false), kept);
    EXPECT_EQ(line.whyNoCells(),
              SortedStep::build(waves<float>({17, 1, 1}, 9, false)).whyNoCells());
}

// What lies between points is made of doubles, which tell no odd numbers apart there.
TEST(CellIndex, WholeNumbersBeyondDoublesHaveNone) {
    const auto with = [](std::int64_t most) {
        Field field = waves<std::int64_t>({5, 4, 3}, 9, false);
        std::get<std::vector<std::int64_t>>(field.values).back() = most;
        return SortedStep::build(std::move(field));
    };
    constexpr std::int64_t kTold = std::int64_t{1} << 53;
    EXPECT_TRUE(with(kTold).canHaveCells());
    EXPECT_TRUE(with(-kTold).canHaveCells());
    for (const std::int64_t most :
         {kTold + 1, -kTold - 2, std::numeric_limits<std::int64_t>::min()}) {
        EXPECT_EQ(with(most).whyNoCells(),
                  "whole numbers beyond 2^53 are told apart by points alone");
        EXPECT_EQ(with(most).cells(), nullptr);
    }
}

TEST(CellIndex, IsTheSameForAnyNumberOfThreads) {
    const Field field = waves<float>({17, 9, 8}, 5, true);
    const CellIndex one(field, 1), five(field, 5);
    const std::vector<Interval<double>> intervals = {{-0.1, 0.1}, {0.5, 0.6}};
    EXPECT_EQ(one.select(intervals), five.select(intervals));
    EXPECT_EQ(selected(one, intervals), selected(five, intervals));
}

// Beyond the outermost points values are repeated; an axis of one point has two half cells.
TEST(CellIndex, IsMadeOfWhatTakesFourGibibytes) {
    // Of n^3 points: 8 (n + 1)^3 + n^3 sizeof(value).
    EXPECT_TRUE(CellIndex::canIndex(*gridOf({512, 512, 512}), ValueType::F64));
    EXPECT_TRUE(CellIndex::canIndex(*gridOf({780, 780, 780}), ValueType::U8));
    EXPECT_FALSE(CellIndex::canIndex(*gridOf({784, 784, 784}), ValueType::U8));
    EXPECT_FALSE(CellIndex::canIndex(*gridOf({780, 780, 780}), ValueType::U16));
    EXPECT_FALSE(CellIndex::canIndex(*gridOf({1024, 1024, 1024}), ValueType::U8));
}

TEST(CellIndex, HalfCellsRepeatTheOutermostValues) {
    Field field;
    field.grid = gridOf({2, 1, 1});
    field.values = std::vector<float>{3, 7};
    const CellIndex index(std::move(field));
    EXPECT_EQ(index.size(), glm::uvec3(3, 2, 2));
    EXPECT_THAT(index.cornersOf().values({0, 0, 0}), testing::Each(3.0));
    EXPECT_THAT(index.cornersOf().values({1, 1, 0}), testing::ElementsAre(3, 7, 3, 7, 3, 7, 3, 7));
    EXPECT_THAT(index.cornersOf().values({2, 0, 1}), testing::Each(7.0));
    EXPECT_EQ(selected(index, {{4, 5}}).size(), 4u) << "the cells between the two";
    EXPECT_EQ(selected(index, {{3, 3}}).size(), 8u);
    EXPECT_EQ(selected(index, {{20, 21}}).size(), 0u);
}

// Values beyond all floats, of one sign and of both, tiny ones, infinities and steps of one ulp.
TEST(CellIndex, ExtremeValuesAreFound) {
    Field field;
    field.grid = gridOf({10, 1, 1});
    field.values =
        std::vector<double>{1e300,  -1e300,   -kInfinity, 5e-324, 0,
                            1e-300, -1.7e308, 1.7e308,    1e15,   std::nextafter(1e15, 2e15)};
    const CellIndex index(std::move(field));
    for (const double v : {1e300, -1e300, 0.0, 5e-324, 1e-300, 1.7e308, -1.7e308, 1e15, 1e9}) {
        const std::vector<std::uint32_t> found = selected(index, {{v, v}});
        EXPECT_TRUE(
            std::ranges::includes(std::set(found.begin(), found.end()), byLooking(index, {{v, v}})))
            << v;
    }
    EXPECT_EQ(byLooking(index, {{-kInfinity, kInfinity}}).size(), index.count());
}

TEST(CellIndex, OfNothingHoldsNothing) {
    Field field;
    field.grid = gridOf({3, 3, 3});
    field.values = std::vector<float>(27, std::numeric_limits<float>::quiet_NaN());
    const CellIndex index(std::move(field));
    EXPECT_EQ(index.count(), 0u);
    EXPECT_TRUE(index.select(std::vector<Interval<double>>{{-1, 1}}).empty());
}

TEST(CellIndex, TheFieldOfAStepIsTheFieldItWasBuiltFrom) {
    for (const bool gaps : {false, true}) {
        const Field whole = waves<std::int16_t>({9, 8, 7}, 8, gaps);
        const Field back = SortedStep::build(whole).field();
        ASSERT_EQ(back.type(), whole.type());
        EXPECT_EQ(back.missing, whole.missing);
        const auto &was = std::get<std::vector<std::int16_t>>(whole.values),
                   &is = std::get<std::vector<std::int16_t>>(back.values);
        for (std::size_t i = 0; i < was.size(); ++i) {
            const bool isMissing = !whole.missing.empty() && whole.missing[i];
            EXPECT_TRUE(isMissing || is[i] == was[i]) << i;
        }
    }
}

}  // namespace
}  // namespace timeseries
