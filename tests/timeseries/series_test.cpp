#include "timeseries/series/series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>

#include "tests/support/step_bytes.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A step of `count` points with the values first, first + 1, ...
std::shared_ptr<const SortedStep> stepOf(std::size_t count, float first = 0) {
    Axis x{.name = "x", .units = "m", .coordinates = {}};
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) {
        x.coordinates.push_back(static_cast<double>(i));
        values.push_back(first + static_cast<float>(i));
    }
    const Axis one{.name = "y", .units = "m", .coordinates = {0.0}};
    return std::make_shared<const SortedStep>(
        SortedStep::build(Field{.grid = std::make_shared<const Grid>(std::array{x, one, one}),
                                .values = values,
                                .missing = {}}));
}

std::uint64_t bytesOf(std::size_t count) { return stepOf(count)->bytes(); }

std::vector<std::size_t> stepsIn(const Series& series, SlotState state) {
    std::vector<std::size_t> steps;
    for (std::size_t i = 0; i < series.stepCount(); ++i)
        if (series.state(i) == state) steps.push_back(i);
    return steps;
}

TEST(Series, SummariesAreWithoutQuantilesWhereNobodyWantsThem) {
    Series series(1, 1000, Quantiles::None);
    series.loaded(0, stepOf(5));
    ASSERT_NE(series.summary(0), nullptr);
    EXPECT_TRUE(series.summary(0)->quantiles.empty());
    EXPECT_EQ(series.summary(0)->points, 5u);
}

TEST(Series, BeginsEmpty) {
    Series series(3, 1000);
    EXPECT_THAT(stepsIn(series, SlotState::Empty), ElementsAre(0, 1, 2));
    EXPECT_EQ(series.use(0), nullptr);
    EXPECT_EQ(series.summary(0), nullptr);
    EXPECT_EQ(series.bytes(), 0u);
    EXPECT_THROW(Series(0, 1000), std::invalid_argument);
}

TEST(Series, HandsOutWhatIsWantedAndMissing) {
    Series series(9, 1'000'000);
    EXPECT_THAT(series.want({4, 5, 4, 6}), ElementsAre(4, 5, 6));
    EXPECT_THAT(stepsIn(series, SlotState::Loading), ElementsAre(4, 5, 6));
    series.loaded(5, stepOf(10));
    EXPECT_THAT(series.want({5, 6, 7}), ElementsAre(6, 7));
    EXPECT_THAT(stepsIn(series, SlotState::Loading), ElementsAre(6, 7));
    EXPECT_THAT(stepsIn(series, SlotState::Loaded), ElementsAre(5));
    EXPECT_THAT(series.want({}), IsEmpty());
    EXPECT_THAT(stepsIn(series, SlotState::Loading), IsEmpty());
}

TEST(Series, TakesAStepThatIsNoLongerWanted) {
    Series series(3, 1'000'000);
    series.want({2});
    series.want({});
    series.loaded(2, stepOf(10));
    EXPECT_EQ(series.state(2), SlotState::Loaded);
}

TEST(Series, AFailedStepSaysWhyAndWaitsForARetry) {
    Series series(3, 1000);
    series.want({1});
    series.failed(1, "disk gone");
    EXPECT_EQ(series.state(1), SlotState::Failed);
    EXPECT_EQ(series.why(1), "disk gone");
    EXPECT_THAT(series.want({1, 2}), ElementsAre(2));
    series.retry(1);
    EXPECT_EQ(series.why(1), "");
    EXPECT_THAT(series.want({1, 2}), ElementsAre(1, 2));
}

TEST(Series, RetryLeavesALoadedStepAlone) {
    Series series(3, 1'000'000);
    series.loaded(1, stepOf(10));
    series.retry(1);
    EXPECT_EQ(series.state(1), SlotState::Loaded);
}

TEST(Series, TheLeastRecentlyUsedStepLeavesFirst) {
    Series series(9, 3 * bytesOf(100));
    for (const std::size_t step : {0, 1, 2}) series.loaded(step, stepOf(100));
    EXPECT_NE(series.use(0), nullptr);
    series.loaded(3, stepOf(100));
    EXPECT_THAT(stepsIn(series, SlotState::Loaded), ElementsAre(0, 2, 3));
    series.loaded(4, stepOf(100));
    EXPECT_THAT(stepsIn(series, SlotState::Loaded), ElementsAre(0, 3, 4));
    EXPECT_EQ(series.bytes(), 3 * bytesOf(100));
}

TEST(Series, AStepThatIsDroppedLeavesItsRoomAndIsHandedOutAnew) {
    Series series(9, 2 * bytesOf(100));
    const auto first = stepOf(100);
    series.loaded(0, first);
    series.loaded(1, stepOf(100));
    EXPECT_EQ(series.drop(0), first);
    EXPECT_EQ(series.bytes(), bytesOf(100));
    EXPECT_EQ(series.drop(0), nullptr);
    EXPECT_EQ(series.summary(0)->points, 100u);
    series.loaded(2, stepOf(100));
    EXPECT_THAT(stepsIn(series, SlotState::Loaded), ElementsAre(1, 2));
    EXPECT_THAT(series.want({0, 1}), ElementsAre(0));
}

TEST(Series, WantedStepsLeaveAfterTheOthersAndTheMostUrgentNever) {
    Series series(9, 3 * bytesOf(100));
    for (const std::size_t step : {0, 1, 2}) series.loaded(step, stepOf(100));
    series.want({1, 0, 5, 6});
    series.loaded(5, stepOf(100));  // 2 is not wanted, though used last
    EXPECT_THAT(stepsIn(series, SlotState::Loaded), ElementsAre(0, 1, 5));
    series.loaded(6, stepOf(100));  // the least urgent of all is 6 itself
    EXPECT_THAT(stepsIn(series, SlotState::Loaded), ElementsAre(0, 1, 5));
}

TEST(Series, AStepLargerThanTheBudgetIsKeptAlone) {
    Series series(9, bytesOf(10));
    EXPECT_THAT(series.want({7}), ElementsAre(7));
    series.loaded(7, stepOf(1000));
    EXPECT_EQ(series.state(7), SlotState::Loaded);
    series.want({8});
    series.loaded(8, stepOf(1000));
    EXPECT_THAT(stepsIn(series, SlotState::Loaded), ElementsAre(8));
}

TEST(Series, WhatWouldNotFitBesideMoreUrgentStepsIsNotHandedOut) {
    Series series(9, 2 * bytesOf(100));
    EXPECT_THAT(series.want({0, 1, 2, 3}), ElementsAre(0, 1, 2, 3));  // no size is known yet
    series.loaded(0, stepOf(100));
    EXPECT_THAT(series.want({0, 1, 2, 3}), ElementsAre(1));
    series.loaded(1, stepOf(100));
    EXPECT_THAT(series.want({0, 1, 2, 3}), IsEmpty());
    EXPECT_THAT(series.want({2, 0, 1}), ElementsAre(2));
}

TEST(Series, LoadingWhatItHandsOutComesToAnEnd) {
    // Whatever the sizes: each round loads all that was handed out, and must not go on for ever.
    std::mt19937_64 random(29);
    for (int round = 0; round < 100; ++round) {
        std::vector<std::size_t> counts(12);
        for (std::size_t& count : counts) count = 1 + random() % 200;
        Series series(counts.size(), bytesOf(1 + random() % 600));
        const std::vector<std::size_t> wishes{3, 4, 5, 6, 7, 8, 2, 1};
        int loads = 0;
        for (auto missing = series.want(wishes); !missing.empty(); missing = series.want(wishes))
            for (const std::size_t step : missing) {
                series.loaded(step, stepOf(counts[step]));
                ASSERT_LT(++loads, 100) << "round " << round;
            }
        EXPECT_EQ(series.state(wishes[0]), SlotState::Loaded) << "round " << round;
    }
}

TEST(Series, TheSummaryOutlivesEviction) {
    Series series(3, bytesOf(2001));
    series.loaded(0, stepOf(2001, -1000));
    series.loaded(1, stepOf(2001));
    EXPECT_EQ(series.state(0), SlotState::Empty);
    const StepSummary* summary = series.summary(0);
    ASSERT_NE(summary, nullptr);
    EXPECT_EQ(summary->points, 2001u);
    EXPECT_EQ(summary->bytes, bytesOf(2001));
    EXPECT_EQ(summary->statistics.points, 2001u);
    EXPECT_EQ(toDouble(summary->statistics.min), -1000);
    EXPECT_EQ(toDouble(summary->statistics.max), 1000);
    ASSERT_EQ(summary->quantiles.size(), 1025u);
    EXPECT_EQ(summary->quantiles.front(), -1000);
    EXPECT_EQ(summary->quantiles[512], 0);
    EXPECT_EQ(summary->quantiles.back(), 1000);
    EXPECT_TRUE(std::is_sorted(summary->quantiles.begin(), summary->quantiles.end()));
}

// A step that has made its cells takes more than when it was loaded.
TEST(Series, WhatAStepGrowsByCountsAndPushesOthersOut) {
    const auto grown = stepOf(100);
    const std::uint64_t before = grown->bytes();
    Series series(3, 3 * before);
    series.want({0, 1, 2});
    series.loaded(0, grown);
    series.loaded(1, stepOf(100));
    series.loaded(2, stepOf(100));
    EXPECT_TRUE(series.recount().empty());
    EXPECT_EQ(series.bytes(), 3 * before);
    ASSERT_NE(grown->cells(), nullptr);
    ASSERT_GT(grown->bytes(), before + 8 * 100);
    const auto left = series.recount();
    ASSERT_FALSE(left.empty());
    EXPECT_EQ(series.state(0), SlotState::Loaded);
    EXPECT_EQ(series.state(2), SlotState::Empty) << "the least urgent";
    EXPECT_EQ(series.summary(0)->bytes, grown->bytes());
    EXPECT_EQ(series.bytes(), grown->bytes() + (2 - left.size()) * before);
    series.loaded(0, stepOf(50));
    EXPECT_EQ(series.bytes(), bytesOf(50) + (2 - left.size()) * before);
}

// So that the next one, which counts as the largest, is asked for again.
TEST(Series, AStepOpenedAgainTakesWhatItTookAtFirst) {
    const auto step = stepOf(1000);
    const auto stored = std::make_shared<const SortedStep>(
        SortedStep::ofFile(tests::opened(tests::written(*step)), step->sharedGrid(), false));
    const std::uint64_t first = stored->bytes(), grown = first + step->size() * 8;
    Series series(2, grown);
    series.loaded(0, stored);
    (void)stored->columns();
    series.recount();
    EXPECT_EQ(series.bytes(), grown);
    EXPECT_THAT(series.want({0, 1}), IsEmpty());
    const auto fewer = std::make_shared<const SortedStep>(stored->reopened());
    EXPECT_EQ(series.replace(0, fewer), stored);
    EXPECT_EQ(series.use(0), fewer);
    EXPECT_EQ(series.bytes(), first);
    EXPECT_THAT(series.want({0, 1}), ElementsAre(1));
}

TEST(Series, AnEvictedStepLivesOnWithWhoeverSharesIt) {
    Series series(3, bytesOf(10));
    EXPECT_THAT(series.loaded(0, stepOf(10, 5)), IsEmpty());
    const std::shared_ptr<const SortedStep> shared = series.use(0);
    EXPECT_THAT(series.loaded(1, stepOf(10)), ElementsAre(shared));
    EXPECT_EQ(series.use(0), nullptr);
    EXPECT_EQ(toDouble(shared->value(0)), 5);
}

TEST(Series, WhatLeavesIsReturned) {
    Series series(5, 2 * bytesOf(100));
    const auto zero = stepOf(100), one = stepOf(100), again = stepOf(100), large = stepOf(200);
    EXPECT_THAT(series.loaded(0, zero), IsEmpty());
    EXPECT_THAT(series.loaded(1, one), IsEmpty());
    EXPECT_THAT(series.loaded(1, again), ElementsAre(one));
    EXPECT_THAT(series.loaded(2, large), ElementsAre(zero, again));
    series.want({2});
    EXPECT_THAT(series.loaded(3, one), ElementsAre(one)) << "itself, which nobody wished";
}

TEST(Series, RandomUseFollowsTheModel) {
    // The model: a map of use times; evict the unwanted by oldest use, then the least urgent.
    std::mt19937_64 random(31);
    for (int round = 0; round < 60; ++round) {
        constexpr std::size_t kSteps = 10;
        const std::uint64_t budget = bytesOf(100 + random() % 400);
        Series series(kSteps, budget);
        std::map<std::size_t, std::pair<std::uint64_t, int>> model;  // step -> bytes, use
        std::vector<std::size_t> wishes;
        for (int clock = 1; clock < 200; ++clock) {
            const std::size_t step = random() % kSteps;
            switch (random() % 3) {
                case 0:
                    wishes.resize(random() % 4);
                    for (std::size_t& w : wishes) w = random() % kSteps;
                    series.want(wishes);
                    break;
                case 1:
                    EXPECT_EQ(series.use(step) != nullptr, model.contains(step))
                        << "round " << round;
                    if (model.contains(step)) model[step].second = clock;
                    break;
                case 2: {
                    const auto sorted = stepOf(1 + random() % 300);
                    series.loaded(step, sorted);
                    model[step] = {sorted->bytes(), clock};
                    break;
                }
            }
            const auto total = [&] {
                std::uint64_t sum = 0;
                for (const auto& [s, entry] : model) sum += entry.first;
                return sum;
            };
            while (total() > budget && model.size() > 1) {
                auto victim = model.end();
                for (auto it = model.begin(); it != model.end(); ++it)
                    if (std::find(wishes.begin(), wishes.end(), it->first) == wishes.end() &&
                        (victim == model.end() || it->second.second < victim->second.second))
                        victim = it;
                if (victim == model.end())
                    for (auto it = model.begin(); it != model.end(); ++it) {
                        const auto place = [&](std::size_t s) {
                            return std::find(wishes.begin(), wishes.end(), s);
                        };
                        if (victim == model.end() || place(it->first) > place(victim->first))
                            victim = it;
                    }
                model.erase(victim);
            }
            std::vector<std::size_t> expected;
            for (const auto& [s, entry] : model) expected.push_back(s);
            ASSERT_EQ(stepsIn(series, SlotState::Loaded), expected)
                << "round " << round << " at " << clock;
            ASSERT_EQ(series.bytes(), total()) << "round " << round << " at " << clock;
        }
    }
}

}  // namespace
}  // namespace timeseries
