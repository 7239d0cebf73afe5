#include "timeseries/series/time_cursor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/cursor_walks.h"

namespace timeseries {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using testing::ElementsAre;
using namespace timeseries::cursor_walks;

TEST(TimeCursor, PingPongShowsTheEndStepsOnce) {
    const TimeCursor cursor(4, {.ending = Ending::PingPong});
    EXPECT_THAT(walk(cursor, 9), ElementsAre(0, 1, 2, 3, 2, 1, 0, 1, 2, 3));
}

TEST(TimeCursor, PingPongOfTwoStepsAlternates) {
    EXPECT_THAT(walk(TimeCursor(2, {.ending = Ending::PingPong}), 4), ElementsAre(0, 1, 0, 1, 0));
}

TEST(TimeCursor, LoopBeginsAgainAndOnceStops) {
    EXPECT_THAT(walk(TimeCursor(3, {.ending = Ending::Loop}), 5), ElementsAre(0, 1, 2, 0, 1, 2));
    TimeCursor once(3, {.ending = Ending::Once, .stepsPerSecond = 1});
    once.advance(3s - 1ns);
    EXPECT_EQ(once.step(), 2u);
    EXPECT_FALSE(once.finished());
    once.advance(1ns);
    EXPECT_EQ(once.step(), 2u);
    EXPECT_TRUE(once.finished());
    EXPECT_EQ(once.untilNextStep(), std::nullopt);
    once.advance(100h);
    EXPECT_EQ(once.step(), 2u);
}

TEST(TimeCursor, BackwardsShowsTheSameStepsTheOtherWay) {
    const CursorSettings s{.first = 1, .last = 8, .stride = 3, .direction = Direction::Backward};
    EXPECT_THAT(walk(TimeCursor(10, s), 4), ElementsAre(7, 4, 1, 7, 4));
}

TEST(TimeCursor, RandomCyclesShowTheStepsInOrder) {
    std::mt19937_64 random(3);
    for (int round = 0; round < 500; ++round) {
        const std::size_t steps = 1 + random() % 12;
        const CursorSettings s = randomSettings(random, steps);
        EXPECT_EQ(cycleOf(TimeCursor(steps, s)), expectedCycle(steps, s)) << describe(steps, s);
    }
}

TEST(TimeCursor, EvenStepsLastEquallyLong) {
    const TimeCursor cursor(5, {.stepsPerSecond = 4});
    EXPECT_THAT(durations(cursor),
                ElementsAre(250'000'000, 250'000'000, 250'000'000, 250'000'000, 250'000'000));
}

TEST(TimeCursor, ThirdsOfASecondDoNotDriftWithinACycle) {
    // Boundaries are k / 3 s, each rounded from the beginning of the cycle.
    TimeCursor cursor(1000, {.stepsPerSecond = 3});
    std::int64_t begin = 0;
    for (std::size_t k = 0; k < 1000; ++k) {
        EXPECT_EQ(begin, std::llround(static_cast<double>(k) * 1e9 / 3)) << "step " << k;
        begin += cursor.untilNextStep()->count();
        cursor.advance(*cursor.untilNextStep());
    }
    EXPECT_EQ(cursor.cycle()->count(), std::llround(1000 * 1e9 / 3));
}

TEST(TimeCursor, RealTimesShowEachStepForItsOwnDuration) {
    // Two units a second; the last of the series stays as long as the one before it.
    const TimeCursor cursor({-1.0, 0.0, 4.0, 4.5},
                            {.pace = Pace::RealTimes, .timeUnitsPerSecond = 2});
    EXPECT_EQ(cursor.whyEven(), std::nullopt);
    EXPECT_THAT(durations(cursor),
                ElementsAre(500'000'000, 2'000'000'000, 250'000'000, 250'000'000));
}

TEST(TimeCursor, AStepLastsAsLongWhicheverWayItIsPlayed) {
    const std::vector<double> times{-1.0, 0.0, 4.0, 4.5};
    const TimeCursor back(times, {.direction = Direction::Backward, .pace = Pace::RealTimes});
    EXPECT_THAT(durations(back),
                ElementsAre(500'000'000, 500'000'000, 4'000'000'000, 1'000'000'000));
    const TimeCursor both(times, {.ending = Ending::PingPong, .pace = Pace::RealTimes});
    EXPECT_THAT(durations(both), ElementsAre(1'000'000'000, 4'000'000'000, 500'000'000, 500'000'000,
                                             500'000'000, 4'000'000'000));
}

TEST(TimeCursor, AnOutPointStepStaysUntilTheStepAfterIt) {
    const CursorSettings s{.last = 1, .pace = Pace::RealTimes};
    EXPECT_THAT(durations(TimeCursor({0.0, 1.0, 8.0, 9.0}, s)),
                ElementsAre(1'000'000'000, 7'000'000'000));
}

TEST(TimeCursor, AStrideAddsUpTheDurationsItPasses) {
    const CursorSettings s{.stride = 2, .pace = Pace::RealTimes};
    // Shown: 0, 2, 4. Step 4 has no step 6 after it and stays as long as step 2.
    EXPECT_THAT(durations(TimeCursor({0.0, 1.0, 3.0, 7.0, 8.0}, s)),
                ElementsAre(3'000'000'000, 5'000'000'000, 5'000'000'000));
}

TEST(TimeCursor, TimesThatDoNotIncreaseFallBackToEvenStepsAndSayWhy) {
    const CursorSettings s{.pace = Pace::RealTimes, .stepsPerSecond = 2};
    for (const std::vector<double>& times :
         {std::vector{0.0, 1.0, 1.0, 2.0}, std::vector{0.0, 1.0, kNan, 2.0},
          std::vector{3.0, 2.0, 1.0, 0.0}, std::vector{0.0, 1.0, 2.0, kInf},
          std::vector{-1e308, 0.0, 1.0, 1e308}, std::vector{-8e307, 0.0, 1.0, 8e307}}) {
        const TimeCursor cursor(times, s);
        ASSERT_TRUE(cursor.whyEven());
        EXPECT_FALSE(cursor.whyEven()->empty());
        EXPECT_THAT(durations(cursor),
                    ElementsAre(500'000'000, 500'000'000, 500'000'000, 500'000'000));
    }
    EXPECT_THAT(*TimeCursor({0.0, 1.0, 1.0, 2.0}, s).whyEven(),
                testing::AllOf(testing::HasSubstr("step 2"), testing::HasSubstr("not later")));
    EXPECT_TRUE(TimeCursor(4, s).whyEven());
    EXPECT_TRUE(TimeCursor(std::vector{5.0}, s).whyEven());
}

TEST(TimeCursor, SaysWhichTimesGiveNoDurations) {
    const auto why = [](const std::vector<double>& times, std::size_t last = 99) {
        return TimeCursor(times, {.last = last, .pace = Pace::RealTimes})
            .whyEven()
            .value_or("nothing");
    };
    EXPECT_EQ(why({0.0, 1.0, 2.0, 1.5}),
              "the time of step 3, 1.5, is not later than that of step 2, 2");
    EXPECT_EQ(why({0.0, 1.0, 2.0, 1.5}, 2),
              "the time of step 3, 1.5, is not later than that of step 2, 2")
        << "it ends step 2";
    EXPECT_EQ(why({0.0, 1.0, 2.0, 1.5}, 1), "nothing");
    EXPECT_EQ(why({0.0, kNan, 2.0}), "the time of step 1 is nan");
    EXPECT_EQ(why({-kInf, 1.0, 2.0}), "the time of step 0 is -inf");
    // A cycle of four spans is still a number.
    const double most = std::numeric_limits<double>::max() / 4;
    EXPECT_EQ(why({0.0, 0.99 * most}), "nothing");
    EXPECT_THAT(why({0.0, 1.01 * most}), testing::HasSubstr("span more than a double holds"));
    // Nothing is said where real times are not asked for.
    EXPECT_EQ(TimeCursor({0.0, kNan}, {.pace = Pace::Even}).whyEven(), std::nullopt);
}

TEST(TimeCursor, TheSlowestCycleLastsThirtySixYearsInEqualShares) {
    const double tiny = std::numeric_limits<double>::denorm_min();
    const TimeCursor cursor(4, {.stepsPerSecond = tiny});
    const double cycle = std::ldexp(1.0, 60);
    EXPECT_NEAR(static_cast<double>(cursor.cycle()->count()), cycle, 1e-9 * cycle);
    for (const std::int64_t ns : durations(cursor))
        EXPECT_NEAR(static_cast<double>(ns), cycle / 4, 1e-9 * cycle);
}

TEST(TimeCursor, TheFastestCycleLastsANanosecondAPlace) {
    for (const Ending ending : {Ending::Loop, Ending::PingPong}) {
        const TimeCursor cursor(5, {.ending = ending, .stepsPerSecond = 1e300});
        EXPECT_EQ(cursor.cycle()->count(), static_cast<std::int64_t>(cursor.placesPerCycle()));
    }
}

TEST(TimeCursor, BadTimesOutsideTheInAndOutPointsDoNotMatter) {
    const CursorSettings s{.first = 1, .last = 2, .pace = Pace::RealTimes};
    const TimeCursor cursor({kNan, 1.0, 2.0, 4.0, 0.0}, s);
    EXPECT_EQ(cursor.whyEven(), std::nullopt);
    EXPECT_THAT(durations(cursor), ElementsAre(1'000'000'000, 2'000'000'000));
}

TEST(TimeCursor, ExtremeSpeedsAndTimesKeepEveryStepVisibleForATime) {
    const double tiny = std::numeric_limits<double>::denorm_min();
    const double huge = std::numeric_limits<double>::max();
    for (const double speed : {tiny, 1e-300, 1e300, huge})
        for (const std::vector<double>& times :
             {std::vector{0.0, tiny, 2 * tiny}, std::vector{-1e307, 0.0, 1e307},
              std::vector{0.0, 1e-200, 1.0}})
            for (const Ending ending : {Ending::Once, Ending::Loop, Ending::PingPong}) {
                CursorSettings s{
                    .ending = ending, .pace = Pace::RealTimes, .timeUnitsPerSecond = speed};
                for (const std::int64_t ns : durations(TimeCursor(times, s)))
                    EXPECT_GE(ns, 1)
                        << "speed " << speed << " times " << times[1] << ", " << times[2];
                s.pace = Pace::Even;
                s.stepsPerSecond = speed;
                for (const std::int64_t ns : durations(TimeCursor(times, s))) EXPECT_GE(ns, 1);
            }
}

TEST(TimeCursor, ThirtyDaysOfOddFramesEndWhereTheClosedFormSays) {
    // A frame at 89.97 Hz with jitter; the expectation is a walk along the cycle's durations.
    std::mt19937_64 random(5);
    const std::vector<double> times = randomTimes(random, 37);
    const CursorSettings s{
        .stride = 2, .ending = Ending::PingPong, .pace = Pace::RealTimes, .timeUnitsPerSecond = 7};
    TimeCursor cursor(times, s);
    const TimeCursor start = cursor;
    nanoseconds elapsed{0};
    while (elapsed < 24h * 30) {
        // A thousand frames a call keep the test short; each is odd in nanoseconds.
        const nanoseconds dt(11'114'815'000 + static_cast<std::int64_t>(random() % 4'000'001));
        cursor.advance(dt);
        elapsed += dt;
    }
    EXPECT_EQ(cursor.step(), start.stepAt(elapsed));

    const std::vector<std::int64_t> lasts = durations(start);
    std::int64_t rest = elapsed.count() % start.cycle()->count();
    std::size_t place = 0;
    while (rest >= lasts[place]) rest -= lasts[place++];
    EXPECT_EQ(cursor.position(), (CursorPosition{place, nanoseconds(rest)}));
}

TEST(TimeCursor, ManyAdvancesAreOneAdvance) {
    std::mt19937_64 random(17);
    for (int round = 0; round < 400; ++round) {
        const std::size_t steps = 1 + random() % 20;
        const CursorSettings s = randomSettings(random, steps);
        TimeCursor parts(randomTimes(random, steps), s);
        parts.seek(random() % steps);
        TimeCursor whole = parts;
        nanoseconds sum{0};
        for (int i = 0; i < 40; ++i) {
            const nanoseconds dt(random() >> (20 + random() % 40));
            parts.advance(dt);
            sum += dt;
        }
        whole.advance(sum);
        EXPECT_EQ(parts, whole) << describe(steps, s);
    }
}

TEST(TimeCursor, TheClosedFormAgreesWithAWalk) {
    std::mt19937_64 random(19);
    for (int round = 0; round < 200; ++round) {
        const std::size_t steps = 1 + random() % 9;
        CursorSettings s = randomSettings(random, steps);
        s.stepsPerSecond += 0.5;
        s.timeUnitsPerSecond += 0.5;
        const TimeCursor cursor(randomTimes(random, steps), s);
        const std::vector<std::size_t> order = expectedCycle(steps, s);
        const std::vector<std::int64_t> lasts =
            order.size() > 1 ? durations(cursor) : std::vector{cursor.cycle()->count()};
        const nanoseconds elapsed(random() >> 20);
        std::int64_t rest = elapsed.count();
        std::size_t place = 0;
        if (s.ending == Ending::Once) {
            while (place + 1 < order.size() && rest >= lasts[place]) rest -= lasts[place++];
        } else {
            rest %= cursor.cycle()->count();
            while (rest >= lasts[place]) rest -= lasts[place++];
        }
        EXPECT_EQ(cursor.stepAt(elapsed), order[place])
            << describe(steps, s) << " at " << elapsed.count();
    }
}

TEST(TimeCursor, HugeElapsedTimesDoNotOverflow) {
    TimeCursor loop(7, {.stepsPerSecond = 1});
    loop.advance(nanoseconds::max());
    loop.advance(nanoseconds::max());
    // 2 (2^63 - 1) ns in whole seconds of a cycle of 7.
    const std::uint64_t twice = 2 * static_cast<std::uint64_t>(nanoseconds::max().count());
    EXPECT_EQ(loop.step(), twice / 1'000'000'000 % 7);
    TimeCursor once(7, {.ending = Ending::Once});
    once.advance(nanoseconds::max());
    once.advance(nanoseconds::max());
    EXPECT_TRUE(once.finished());
}

TEST(TimeCursor, SpeedZeroStandsStill) {
    TimeCursor cursor(5, {.stepsPerSecond = 0});
    cursor.seek(3);
    cursor.advance(1000h);
    EXPECT_EQ(cursor.step(), 3u);
    EXPECT_EQ(cursor.cycle(), std::nullopt);
    EXPECT_EQ(cursor.untilNextStep(), std::nullopt);
    // Each pace has its own speed.
    const std::vector<double> times{0.0, 1.0, 2.0};
    EXPECT_EQ(TimeCursor(times, {.pace = Pace::RealTimes, .timeUnitsPerSecond = 0}).cycle(),
              std::nullopt);
    EXPECT_EQ(TimeCursor(times, {.pace = Pace::RealTimes, .stepsPerSecond = 0}).cycle(), 3s);
}

TEST(TimeCursor, StandingStillKeepsHowMuchOfAStepHasGone) {
    for (const double zero : {0.0, -0.0}) {
        TimeCursor cursor(5, {.stepsPerSecond = 1});
        cursor.advance(2250ms);
        CursorSettings s = cursor.settings();
        s.stepsPerSecond = zero;
        cursor.set(s);
        EXPECT_EQ(cursor.untilNextStep(), std::nullopt);
        s.stepsPerSecond = 2;
        cursor.set(s);
        EXPECT_EQ(cursor.step(), 2u);
        EXPECT_EQ(cursor.untilNextStep(), 375ms);
    }
}

TEST(TimeCursor, ALoneStepNeverChanges) {
    EXPECT_EQ(TimeCursor(1).untilNextStep(), std::nullopt);
    EXPECT_EQ(TimeCursor(1, {.ending = Ending::PingPong}).untilNextStep(), std::nullopt);
    EXPECT_EQ(TimeCursor(1, {.ending = Ending::Once, .stepsPerSecond = 1}).untilNextStep(), 1s);
}

TEST(TimeCursor, TheClosedFormBeginsWithTheCycleWhereverTheCursorStands) {
    TimeCursor cursor(5, {.stepsPerSecond = 1});
    cursor.seek(3);
    EXPECT_EQ(cursor.stepAt(1500ms), 1u);
    EXPECT_EQ(cursor.step(), 3u);
}

TEST(TimeCursor, TimeThatGoesBackCountsAsNone) {
    TimeCursor cursor(5, {.stepsPerSecond = 2}, {.place = 2, .into = 5ns});
    const TimeCursor before = cursor;
    cursor.advance(-1h);
    EXPECT_EQ(cursor, before);
}

}  // namespace
}  // namespace timeseries
