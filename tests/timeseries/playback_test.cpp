#include "timeseries/series/playback.h"

#include <gtest/gtest.h>

#include <random>

namespace timeseries {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

ValueSweep sweepOf(double frequency) {
    return ValueSweep({.animation = RangeSet::parse("0:1"), .frequency = frequency});
}

TEST(Playback, MovesNothingWhilePaused) {
    Playback playback{.time = TimeCursor(10), .sweep = sweepOf(1)};
    const Playback before = playback;
    EXPECT_EQ(playback.advance(10s), (Playback::Change{}));
    EXPECT_EQ(playback, before);
    EXPECT_EQ(playback.untilNextChange(), std::nullopt);
}

TEST(Playback, MovesEachCursorAloneOrBoth) {
    for (const bool time : {false, true})
        for (const bool sweep : {false, true}) {
            Playback playback{.time = TimeCursor(10, {.stepsPerSecond = 1}), .sweep = sweepOf(0.1)};
            playback.timeMoves = time;
            playback.sweepMoves = sweep;
            playback.play();
            const Playback::Change change = playback.advance(5s);
            EXPECT_EQ(change, (Playback::Change{.step = time, .window = sweep}));
            EXPECT_EQ(playback.time->step(), time ? 5u : 0u);
            EXPECT_EQ(playback.sweep->tick(), sweep ? 128 : 0);  // half of the ten seconds' cycle
        }
}

TEST(Playback, EitherCursorMayBeAbsent) {
    Playback none;
    none.play();
    EXPECT_EQ(none.advance(1h), (Playback::Change{}));
    Playback onlySweep{.sweep = sweepOf(1)};
    onlySweep.play();
    EXPECT_TRUE(onlySweep.advance(100ms).window);
    Playback onlyTime{.time = TimeCursor(3)};
    onlyTime.play();
    EXPECT_TRUE(onlyTime.advance(100ms).step);
}

TEST(Playback, PausesWhenTheStepsHavePlayedOnceAndBeginsAgainOnPlay) {
    Playback playback{.time = TimeCursor(3, {.ending = Ending::Once, .stepsPerSecond = 1})};
    playback.play();
    playback.advance(2s);
    EXPECT_TRUE(playback.playing);
    EXPECT_EQ(playback.untilNextChange(), 1s);
    playback.advance(1s);
    EXPECT_FALSE(playback.playing);
    EXPECT_EQ(playback.time->step(), 2u);
    playback.toggle();
    EXPECT_TRUE(playback.playing);
    EXPECT_EQ(playback.time->step(), 0u);
}

// Reached by hand, too; where there is no other step to show, there is nothing to begin again.
TEST(Playback, FromTheLastStepItBeginsAgain) {
    for (const Direction direction : {Direction::Forward, Direction::Backward}) {
        const std::size_t from = direction == Direction::Forward ? 0 : 2;
        Playback playback{
            .time = TimeCursor(
                3, {.ending = Ending::Once, .direction = direction, .stepsPerSecond = 1})};
        playback.time->seek(2 - from);
        playback.play();
        EXPECT_EQ(playback.time->step(), from);
        playback.pause();
        playback.time->seek(1);
        playback.play();
        EXPECT_EQ(playback.time->step(), 1u);
    }
    Playback loop{.time = TimeCursor(3, {.ending = Ending::Loop})};
    loop.time->seek(2);
    loop.play();
    EXPECT_EQ(loop.time->step(), 2u);
}

TEST(Playback, KeepsPlayingWhileTheWindowMoves) {
    Playback playback{.time = TimeCursor(3, {.ending = Ending::Once}), .sweep = sweepOf(0.1)};
    playback.play();
    playback.advance(5s);
    EXPECT_TRUE(playback.time->finished());
    EXPECT_TRUE(playback.playing);
}

TEST(Playback, PlaysNothingWhereNothingWouldMove) {
    for (const TimeCursor& still :
         {TimeCursor(1), TimeCursor(5, {.stepsPerSecond = 0}),
          TimeCursor(5, {.first = 2, .last = 2}), TimeCursor(1, {.ending = Ending::PingPong})}) {
        Playback playback{.time = still};
        playback.time->seek(4);
        const Playback before = playback;
        playback.toggle();
        EXPECT_EQ(playback, before);
        // One that plays, and comes to stand still.
        playback.playing = true;
        playback.advance(1ms);
        playback.advance(0ms);
        EXPECT_FALSE(playback.playing);
    }
    Playback swept{.time = TimeCursor(1), .sweep = sweepOf(1)};
    swept.play();
    EXPECT_TRUE(swept.playing);
}

TEST(Playback, FromAsideItEntersAtOnceIfTimeMoves) {
    for (const bool timeMoves : {true, false}) {
        Playback playback{
            .time = TimeCursor(10, {.first = 4}), .sweep = sweepOf(1), .timeMoves = timeMoves};
        playback.time->seek(1);
        playback.play();
        EXPECT_EQ(playback.time->step(), timeMoves ? 4u : 1u);
    }
}

TEST(Playback, SeekingWhilePausedIsRemembered) {
    Playback playback{.time = TimeCursor(10, {.stepsPerSecond = 1}), .sweep = sweepOf(0.1)};
    playback.play();
    playback.advance(500ms);
    playback.pause();
    playback.time->seek(7);
    playback.sweep->seek(64);
    playback.play();
    playback.advance(1s);
    EXPECT_EQ(playback.time->step(), 8u);
    EXPECT_EQ(playback.sweep->tick(), 64 + 25);  // 25.6 ticks a second
}

TEST(Playback, TheNextChangeIsTheNearerOfTheTwo) {
    Playback playback{.time = TimeCursor(10, {.stepsPerSecond = 3}), .sweep = sweepOf(0.05)};
    playback.play();
    for (int i = 0; i < 300; ++i) {
        const nanoseconds wait = *playback.untilNextChange();
        EXPECT_EQ(playback.advance(wait - 1ns), (Playback::Change{}));
        const Playback::Change change = playback.advance(1ns);
        EXPECT_TRUE(change.step || change.window) << "change " << i;
    }
}

TEST(Playback, DroppedFramesDoNotSlowIt) {
    std::mt19937_64 random(23);
    Playback smooth{.time = TimeCursor(97, {.ending = Ending::PingPong, .stepsPerSecond = 29.97}),
                    .sweep = sweepOf(0.37)};
    smooth.play();
    Playback rough = smooth;
    nanoseconds elapsed{0};
    for (int second = 0; second < 100; ++second) {
        const nanoseconds late(random() % 1'000'000'000);
        rough.advance(late);
        rough.advance(1s - late);
        for (int frame = 0; frame < 90; ++frame) smooth.advance(nanoseconds(11'111'111));
        smooth.advance(nanoseconds(1'000'000'000 - 90 * 11'111'111));
        elapsed += 1s;
    }
    EXPECT_EQ(smooth, rough);
    EXPECT_EQ(smooth.time->step(), TimeCursor(97, smooth.time->settings()).stepAt(elapsed));
}

}  // namespace
}  // namespace timeseries
