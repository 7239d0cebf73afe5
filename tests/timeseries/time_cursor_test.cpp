#include "timeseries/series/time_cursor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace timeseries {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using testing::ElementsAre;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::vector<std::size_t> cycleOf(const TimeCursor& cursor) {
    std::vector<std::size_t> steps;
    for (std::size_t p = 0; p < cursor.placesPerCycle(); ++p)
        steps.push_back(cursor.stepOfPlace(p));
    return steps;
}

// What playing shows, one entry a change, walked by waiting for each change.
std::vector<std::size_t> walk(TimeCursor cursor, std::size_t changes) {
    std::vector<std::size_t> steps{cursor.step()};
    for (std::size_t i = 0; i < changes && cursor.untilNextStep(); ++i) {
        cursor.advance(*cursor.untilNextStep());
        steps.push_back(cursor.step());
    }
    return steps;
}

// How long each place of the cycle is shown.
std::vector<std::int64_t> durations(TimeCursor cursor) {
    std::vector<std::int64_t> ns;
    for (std::size_t p = 0; p < cursor.placesPerCycle(); ++p) {
        ns.push_back(cursor.untilNextStep()->count());
        cursor.advance(*cursor.untilNextStep());
    }
    return ns;
}

// The order of a cycle from first principles: list the shown steps, turn, append the way back.
std::vector<std::size_t> expectedCycle(std::size_t steps, const CursorSettings& s) {
    std::vector<std::size_t> shown;
    for (std::size_t i = s.first; i <= std::min(s.last, steps - 1); i += s.stride)
        shown.push_back(i);
    if (s.direction == Direction::Backward) shown = {shown.rbegin(), shown.rend()};
    if (s.ending == Ending::PingPong)
        for (std::size_t k = shown.size(); k-- > 2;) shown.push_back(shown[k - 1]);
    return shown;
}

CursorSettings randomSettings(std::mt19937_64& random, std::size_t steps) {
    CursorSettings s;
    s.first = random() % steps;
    s.last = s.first + random() % (steps + 3);
    s.stride = 1 + random() % 4;
    s.ending = static_cast<Ending>(random() % 3);
    s.direction = static_cast<Direction>(random() % 2);
    s.pace = static_cast<Pace>(random() % 2);
    s.stepsPerSecond = static_cast<double>(random() % 100000) / 997;
    s.timeUnitsPerSecond = static_cast<double>(random() % 100000) / 997;
    return s;
}

std::vector<double> randomTimes(std::mt19937_64& random, std::size_t steps) {
    std::vector<double> times{-static_cast<double>(random() % 1000)};
    while (times.size() < steps)
        times.push_back(times.back() + 0.01 + static_cast<double>(random() % 1000) / 77);
    return times;
}

std::string describe(std::size_t steps, const CursorSettings& s) {
    return "steps " + std::to_string(steps) + " first " + std::to_string(s.first) + " last " +
           std::to_string(s.last) + " stride " + std::to_string(s.stride) + " ending " +
           std::to_string(static_cast<int>(s.ending)) + " direction " +
           std::to_string(static_cast<int>(s.direction)) + " pace " +
           std::to_string(static_cast<int>(s.pace)) + " steps/s " +
           std::to_string(s.stepsPerSecond) + " units/s " + std::to_string(s.timeUnitsPerSecond);
}

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

TEST(TimeCursor, SeekGoesToAnyStepAndPlayGoesOnFromTheNearestShown) {
    TimeCursor cursor(20, {.first = 2, .last = 14, .stride = 4});  // 2, 6, 10, 14
    const auto enteredFrom = [&](std::size_t step) {
        cursor.seek(step);
        EXPECT_EQ(cursor.step(), std::min<std::size_t>(step, 19));
        TimeCursor played = cursor;
        cursor.enter();
        EXPECT_EQ(played.isAside(), played.step() != cursor.step());
        if (played.isAside()) {
            EXPECT_EQ(played.untilNextStep(), 1ns);
            EXPECT_EQ(played.upcoming(2), (std::vector{played.step(), cursor.step()}));
            EXPECT_EQ(played.upcoming(1), std::vector{played.step()});
            EXPECT_TRUE(played.upcoming(0).empty());
        }
        played.advance(1ns);
        EXPECT_EQ(played.step(), cursor.step());
        return cursor.step();
    };
    EXPECT_EQ(enteredFrom(0), 2u);
    EXPECT_EQ(enteredFrom(3), 2u);
    EXPECT_EQ(enteredFrom(4), 2u);  // as near to 6: the earlier
    EXPECT_EQ(enteredFrom(5), 6u);
    EXPECT_EQ(enteredFrom(10), 10u);
    EXPECT_EQ(enteredFrom(13), 14u);
    EXPECT_EQ(enteredFrom(1000), 14u);
    // The out point lies beyond the last shown step by more than half a stride.
    TimeCursor cut(20, {.first = 2, .last = 17, .stride = 4});
    cut.seek(17);
    cut.enter();
    EXPECT_EQ(cut.step(), 14u);
}

TEST(TimeCursor, SteppingByHandReachesEveryStepBesideThoseThatPlay) {
    TimeCursor cursor(20, {.first = 5, .last = 12, .stride = 3});  // 5, 8, 11
    const auto walked = [&](std::size_t from, void (TimeCursor::*step)(), int count) {
        cursor.seek(from);
        std::vector<std::size_t> steps;
        while (count-- > 0) {
            (cursor.*step)();
            steps.push_back(cursor.step());
        }
        return steps;
    };
    EXPECT_THAT(walked(3, &TimeCursor::stepForward, 4), ElementsAre(4, 5, 8, 11));
    EXPECT_THAT(walked(1, &TimeCursor::stepBackward, 3), ElementsAre(0, 0, 0));
    EXPECT_THAT(walked(18, &TimeCursor::stepForward, 3), ElementsAre(19, 19, 19));
    EXPECT_THAT(walked(14, &TimeCursor::stepBackward, 4), ElementsAre(13, 12, 11, 8));
    // Between those that play.
    EXPECT_THAT(walked(6, &TimeCursor::stepForward, 1), ElementsAre(8));
    EXPECT_THAT(walked(6, &TimeCursor::stepBackward, 1), ElementsAre(5));
    EXPECT_THAT(walked(7, &TimeCursor::stepForward, 1), ElementsAre(8));
    EXPECT_THAT(walked(7, &TimeCursor::stepBackward, 1), ElementsAre(5));
    EXPECT_THAT(walked(12, &TimeCursor::stepForward, 1), ElementsAre(5)) << "Loop goes round";
    for (const Ending ending : {Ending::Once, Ending::PingPong}) {
        cursor.set({.first = 5, .last = 12, .stride = 3, .ending = ending});
        EXPECT_THAT(walked(12, &TimeCursor::stepForward, 2), ElementsAre(12, 12)) << "others stay";
        EXPECT_THAT(walked(12, &TimeCursor::stepBackward, 2), ElementsAre(11, 8));
    }
    cursor.set({.first = 5, .last = 7, .stride = 3});
    EXPECT_THAT(walked(6, &TimeCursor::stepForward, 2), ElementsAre(5, 5)) << "a round of one step";
}

TEST(TimeCursor, SeekingAndSteppingGoToTheBeginningOfAStep) {
    TimeCursor cursor(5, {.stepsPerSecond = 1}, {.place = 2, .into = 300ms});
    const auto gone = [&] { return cursor.position().into; };
    cursor.seek(2);
    EXPECT_EQ(gone(), 0ns);
    cursor.advance(300ms);
    cursor.stepForward();
    EXPECT_EQ(gone(), 0ns);
    cursor.advance(300ms);
    cursor.stepBackward();
    EXPECT_EQ(gone(), 0ns);
}

TEST(TimeCursor, SeekingToAnEndOnTheWayBackIsInTheCycle) {
    for (const Direction direction : {Direction::Forward, Direction::Backward}) {
        TimeCursor cursor(4, {.ending = Ending::PingPong, .direction = direction});
        for (const std::size_t sought : {0, 3, 1, 2}) {
            cursor.restart();
            for (int i = 0; i < 4; ++i) cursor.advance(*cursor.untilNextStep());  // returning
            cursor.seek(sought);
            ASSERT_LT(cursor.position().place, cursor.placesPerCycle());
            EXPECT_EQ(cursor.step(), sought);
            // An inner step is still on the way back.
            const bool forward = direction == Direction::Forward;
            const std::size_t next = sought == 0   ? 1
                                     : sought == 3 ? 2
                                     : forward     ? sought - 1
                                                   : sought + 1;
            EXPECT_THAT(walk(cursor, 1), ElementsAre(sought, next));
        }
    }
}

TEST(TimeCursor, SteppingByHandGoesRoundInALoopAndStaysAtTheEndsOtherwise) {
    for (const Direction direction : {Direction::Forward, Direction::Backward}) {
        TimeCursor loop(5, {.ending = Ending::Loop, .direction = direction});
        loop.seek(4);
        loop.stepForward();
        EXPECT_EQ(loop.step(), 0u);
        loop.stepBackward();
        EXPECT_EQ(loop.step(), 4u);
        loop.stepBackward();
        EXPECT_EQ(loop.step(), 3u);
        loop.stepForward();
        EXPECT_EQ(loop.step(), 4u);
        loop.seek(1);
        loop.stepBackward();
        EXPECT_EQ(loop.step(), 0u);
        for (const Ending ending : {Ending::Once, Ending::PingPong}) {
            TimeCursor cursor(5, {.ending = ending, .direction = direction});
            cursor.seek(4);
            cursor.stepForward();
            EXPECT_EQ(cursor.step(), 4u);
            cursor.seek(0);
            cursor.stepBackward();
            EXPECT_EQ(cursor.step(), 0u);
            cursor.stepForward();
            EXPECT_EQ(cursor.step(), 1u);
        }
    }
}

TEST(TimeCursor, SteppingByHandRunsAgainAfterTheEnd) {
    TimeCursor once(3, {.ending = Ending::Once});
    once.advance(1h);
    once.stepBackward();
    EXPECT_FALSE(once.finished());
    EXPECT_EQ(once.step(), 1u);
}

TEST(TimeCursor, SteppingByHandKeepsThePingPongsWay) {
    TimeCursor cursor(6, {.ending = Ending::PingPong, .stepsPerSecond = 1});
    cursor.advance(7s);  // 0 1 2 3 4 5 4 3
    ASSERT_EQ(cursor.step(), 3u);
    cursor.stepForward();
    EXPECT_THAT(walk(cursor, 3), ElementsAre(4, 3, 2, 1));
}

TEST(TimeCursor, NewSettingsKeepTheStepShown) {
    TimeCursor cursor(100, {.stepsPerSecond = 1});
    cursor.advance(40s + 250ms);
    CursorSettings s = cursor.settings();
    s.stepsPerSecond = 10;  // a quarter of the step's time has gone: it stays so
    cursor.set(s);
    EXPECT_EQ(cursor.step(), 40u);
    EXPECT_EQ(cursor.untilNextStep(), 75ms);
    s.first = 60;
    cursor.set(s);
    EXPECT_EQ(cursor.step(), 40u);
    cursor.advance(1ns);
    EXPECT_EQ(cursor.step(), 60u);
    s.direction = Direction::Backward;
    s.first = 0;
    cursor.set(s);
    EXPECT_THAT(walk(cursor, 2), ElementsAre(60, 59, 58));
}

TEST(TimeCursor, AStepThatPlaysNoMoreIsLeftForTheBeginningOfTheNearest) {
    TimeCursor cursor(9, {.stepsPerSecond = 1});
    cursor.advance(3300ms);
    cursor.set({.stride = 2});
    EXPECT_EQ(cursor.step(), 3u);
    EXPECT_TRUE(cursor.isAside());
    cursor.enter();
    EXPECT_EQ(cursor.position(), (CursorPosition{1, 0ns}));
    EXPECT_EQ(cursor.step(), 2u);
}

TEST(TimeCursor, NewSettingsKeepTheWayBack) {
    TimeCursor cursor(6, {.ending = Ending::PingPong, .stepsPerSecond = 1});
    cursor.advance(7s);  // 0 1 2 3 4 5 4 3
    CursorSettings s = cursor.settings();
    s.stepsPerSecond = 5;
    cursor.set(s);
    EXPECT_THAT(walk(cursor, 2), ElementsAre(3, 2, 1));
}

TEST(TimeCursor, NewSettingsBeginTheLastStepAgainAfterTheEnd) {
    TimeCursor cursor(3, {.ending = Ending::Once, .stepsPerSecond = 1});
    cursor.advance(1h);
    ASSERT_TRUE(cursor.finished());
    for (const Ending ending : {Ending::Once, Ending::Loop}) {
        TimeCursor changed = cursor;
        CursorSettings s = cursor.settings();
        s.ending = ending;
        changed.set(s);
        EXPECT_EQ(changed.position(), (CursorPosition{2, 0ns}));
    }
}

TEST(TimeCursor, AnotherDirectionTurnsAPingPongRound) {
    TimeCursor cursor(6, {.ending = Ending::PingPong, .stepsPerSecond = 1});
    cursor.advance(2s);
    CursorSettings s = cursor.settings();
    s.direction = Direction::Backward;
    cursor.set(s);
    EXPECT_THAT(walk(cursor, 4), ElementsAre(2, 1, 0, 1, 2));
}

TEST(TimeCursor, UpcomingIsTheOrderOfPlayEachStepOnce) {
    TimeCursor loop(5, {});
    loop.seek(3);
    EXPECT_THAT(loop.upcoming(4), ElementsAre(3, 4, 0, 1));
    EXPECT_THAT(loop.upcoming(99), ElementsAre(3, 4, 0, 1, 2));
    TimeCursor once(5, {.ending = Ending::Once});
    once.seek(3);
    EXPECT_THAT(once.upcoming(4), ElementsAre(3, 4));
    TimeCursor pingPong(5, {.ending = Ending::PingPong});
    pingPong.seek(3);
    EXPECT_THAT(pingPong.upcoming(4), ElementsAre(3, 4, 2, 1));  // 3 4 (3) 2 1
}

TEST(TimeCursor, WhatASessionStoresComesBackEqual) {
    const std::vector<double> times{0.0, 1.0, kNan, 3.0};
    TimeCursor cursor(times, {.first = 1, .ending = Ending::PingPong, .pace = Pace::RealTimes});
    cursor.advance(12'345'678'901ns);
    EXPECT_EQ(TimeCursor(times, cursor.settings(), cursor.position()), cursor);
    TimeCursor other = cursor;
    other.advance(1ns);
    EXPECT_FALSE(other == cursor);
}

TEST(TimeCursor, OfOtherTimesIsAnotherCursor) {
    const TimeCursor without(2), with(std::vector{0.0, 1.0}), later(std::vector{0.0, 2.0}),
        missing(std::vector{0.0, kNan});
    const std::vector<const TimeCursor*> all = {&without, &with, &later, &missing};
    for (const TimeCursor* a : all)
        for (const TimeCursor* b : all) EXPECT_EQ(*a == *b, a == b);
    EXPECT_TRUE(missing == TimeCursor(std::vector{0.0, kNan}));
}

TEST(TimeCursor, APositionOutsideTheCycleIsBroughtInside) {
    const TimeCursor cursor(3, {.stepsPerSecond = 1}, {.place = 77, .into = 1h});
    EXPECT_EQ(cursor.step(), 2u);
    EXPECT_EQ(cursor.untilNextStep(), 1ns);
    // Of what plays once, the end of the last step is a place to stand, and of no other.
    const CursorSettings once{.ending = Ending::Once, .stepsPerSecond = 1};
    EXPECT_TRUE(TimeCursor(3, once, {.place = 77, .into = 1h}).finished());
    EXPECT_EQ(TimeCursor(3, once, {.place = 1, .into = 1h}).untilNextStep(), 1ns);
}

TEST(TimeCursor, RefusesSettingsThatCannotBePlayed) {
    EXPECT_THROW(TimeCursor(std::size_t{0}), std::invalid_argument);
    EXPECT_THROW(TimeCursor(std::vector<double>{}), std::invalid_argument);
    EXPECT_THROW(TimeCursor(5, {.first = 5}), std::invalid_argument);
    EXPECT_THROW(TimeCursor(5, {.first = 3, .last = 2}), std::invalid_argument);
    EXPECT_THROW(TimeCursor(5, {.stride = 0}), std::invalid_argument);
    for (const double bad : {-1.0, kNan, kInf}) {
        EXPECT_THROW(TimeCursor(5, {.stepsPerSecond = bad}), std::invalid_argument);
        EXPECT_THROW(TimeCursor(5, {.timeUnitsPerSecond = bad}), std::invalid_argument);
    }
}

}  // namespace
}  // namespace timeseries
