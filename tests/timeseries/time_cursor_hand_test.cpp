// A cursor that is moved by hand, or whose settings change.
#include "timeseries/series/time_cursor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/cursor_walks.h"

namespace timeseries {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using namespace timeseries::cursor_walks;

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
