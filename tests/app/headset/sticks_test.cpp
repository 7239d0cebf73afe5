#include "app/headset/sticks.h"

#include <gmock/gmock.h>

#include "tests/support/scripted_exploration.h"

namespace app::headset {
namespace {

using namespace std::chrono_literals;
using timeseries::Range;
using timeseries::RangeSet;
using timeseries::ValueSweep;

constexpr auto kFrame = 10ms;

TEST(StickRate, RestsInTheMiddleAndGrowsToTheEnds) {
    EXPECT_EQ(rateOf(0), 0);
    EXPECT_EQ(rateOf(0.14), 0);
    EXPECT_EQ(rateOf(-0.14), 0);
    EXPECT_EQ(rateOf(1), 1);
    EXPECT_EQ(rateOf(-1), -1);
    for (double x = 0.2; x < 1; x += 0.1) {
        EXPECT_GT(rateOf(x), rateOf(x - 0.05));
        EXPECT_EQ(rateOf(-x), -rateOf(x));
    }
}

class SticksOfAnExploration : public testing::Test {
 protected:
    // Values 0 to 63 in every step.
    tests::ScriptedExploration world_;
    Exploration& e_ = world_.exploration;
    Sticks sticks_;

    // Both sticks for so long; what was reached on the way.
    Sticks::Ends hold(double value, double time, std::chrono::nanoseconds duration) {
        Sticks::Ends ends;
        for (std::chrono::nanoseconds t{0}; t < duration; t += kFrame) {
            const Sticks::Ends now = sticks_.move(e_, value, time, kFrame);
            ends.value |= now.value;
            ends.time |= now.time;
        }
        return ends;
    }
    void sweep(timeseries::SweepPath path) { world_.sweep("0:63", 2, path); }
    double contour() const { return e_.playback().sweep->contour(); }
    void choose(const char* ranges) {
        Explorer next = e_.explorer();
        next.layers = {{.ranges = RangeSet::parse(ranges), .color = glm::dvec3(1), .opacity = 0.5}};
        e_.edit(next);
    }
    std::uint64_t bruteForceCount() const {
        const Range window = ValueSweep(*sweepOf(e_.explorer())).window(e_.explorer().play.tick);
        const double lo = timeseries::toDouble(window.lo.value),
                     hi = timeseries::toDouble(window.hi.value);
        std::uint64_t count = 0;
        for (std::size_t i = 0; i < 64; ++i) {
            const double value = world_.world.value(0, e_.shown()->step, i);
            count += value >= lo && value <= hi ? 1 : 0;
        }
        return count;
    }
};

TEST_F(SticksOfAnExploration, TheWindowFollowsTheStickAndTheCountTheWindow) {
    for (const auto path : {timeseries::SweepPath::Loop, timeseries::SweepPath::Swing}) {
        sweep(path);
        e_.seekTick(0);
        double before = contour();
        for (int i = 0; i < 20; ++i) {
            hold(1, 0, 150ms);
            EXPECT_GT(contour(), before);
            before = contour();
            EXPECT_EQ(e_.counts()->layers.front(), bruteForceCount());
        }
        hold(-1, 0, 500ms);
        EXPECT_LT(contour(), before) << "the other way";
    }
}

TEST_F(SticksOfAnExploration, AFullWayTakesItsTimeAndEndsThere) {
    for (const auto path : {timeseries::SweepPath::Loop, timeseries::SweepPath::Swing}) {
        sweep(path);
        e_.seekTick(0);
        EXPECT_FALSE(hold(1, 0, 3900ms).value);
        EXPECT_GT(contour(), 60);
        EXPECT_LT(contour(), 63);
        EXPECT_TRUE(hold(1, 0, 200ms).value);
        EXPECT_NEAR(contour(), 63, 1e-9);
        EXPECT_TRUE(hold(-1, 0, 4100ms).value);
        EXPECT_NEAR(contour(), 0, 1e-9);
    }
}

TEST_F(SticksOfAnExploration, OnASwingsWayBackRightIsStillMore) {
    sweep(timeseries::SweepPath::Swing);
    e_.seekTick(e_.playback().sweep->ticksPerCycle() * 3 / 4);
    const double before = contour();
    hold(1, 0, 300ms);
    EXPECT_GT(contour(), before);
    EXPECT_LT(contour(), before + 10) << "without a jump";
}

TEST_F(SticksOfAnExploration, WithoutASweepTheFirstVisibleLayerMoves) {
    choose("10:20");
    hold(1, 0, 2000ms);
    const auto ranges = e_.explorer().layers[0].ranges.ranges();
    const double lo = timeseries::toDouble(ranges[0].lo.value),
                 hi = timeseries::toDouble(ranges[0].hi.value);
    EXPECT_NEAR(lo, 10 + 63.0 / 2, 1e-6) << "half the values in half the time of a way";
    EXPECT_NEAR(hi - lo, 10, 1e-9);
    EXPECT_TRUE(hold(1, 0, 4000ms).value) << "stops where it would leave the values";
    hold(0, 0, kFrame);
    e_.undo();
    EXPECT_TRUE(e_.explorer().layers[0].ranges == RangeSet::parse("10:20")) << "one step of undo";
}

TEST_F(SticksOfAnExploration, ALayerOfAllValuesStays) {
    choose("min:max");
    EXPECT_FALSE(hold(1, 0, 500ms).value) << "nothing moves, so no end is felt";
    EXPECT_TRUE(e_.explorer().layers[0].ranges == RangeSet::parse("min:max"));
}

TEST_F(SticksOfAnExploration, TimeIsScrubbedThereAndBack) {
    e_.seek(0);
    hold(0, 1, 1000ms);
    const std::size_t there = e_.explorer().steps->first;
    EXPECT_GE(there, 1u);
    EXPECT_LE(there, 3u) << "ten steps in four seconds";
    hold(0, -1, 1000ms);
    EXPECT_LE(e_.explorer().steps->first, 1u);
}

TEST_F(SticksOfAnExploration, ATapOfTheTimeStickIsOneStep) {
    e_.seek(4);
    const auto step = [&] { return e_.explorer().steps->first; };
    std::size_t expected = 4;
    for (const double side : {1.0, 1.0, -1.0, 1.0, -1.0, -1.0}) {
        hold(0, side, 80ms);
        expected = side > 0 ? expected + 1 : expected - 1;
        EXPECT_EQ(step(), expected);
        hold(0, 0.05 * side, 20ms);
        EXPECT_EQ(step(), expected) << "the way back is none";
    }
    // As a stick is seen that springs over its rest in one frame, and as a slow display sees it.
    for (const double at : {0.6, 1.0, 0.7, -0.6, -1.0}) hold(0, at, kFrame);
    EXPECT_EQ(step(), expected) << "one there, one back";
    hold(0, 0, kFrame);
    sticks_.move(e_, 0, 0.9, 100ms);
    EXPECT_EQ(step(), expected + 1);
}

TEST_F(SticksOfAnExploration, AGentlePushOfTheTimeStickIsNoTap) {
    e_.seek(4);
    hold(0, 0.4, 200ms);
    EXPECT_EQ(e_.explorer().steps->first, 4u);
    hold(0, 0.9, 40ms);
    EXPECT_EQ(e_.explorer().steps->first, 5u);
    hold(0, 0.4, 10s);
    EXPECT_GT(e_.explorer().steps->first, 5u) << "held, it goes on at its rate";
}

TEST_F(SticksOfAnExploration, TimeEndsAreFeltWhereItDoesNotGoRound) {
    Explorer next = e_.explorer();
    next.play.time.ending = timeseries::Ending::Once;
    e_.edit(next);
    e_.seek(9);
    EXPECT_TRUE(hold(0, 1, 1000ms).time);
    EXPECT_EQ(e_.explorer().steps->first, 9u);
}

TEST_F(SticksOfAnExploration, SticksAtRestChangeNothing) {
    sweep(timeseries::SweepPath::Loop);
    const Explorer before = e_.explorer();
    hold(0.1, -0.1, 1000ms);
    EXPECT_TRUE(e_.explorer() == before);
}

TEST_F(SticksOfAnExploration, ThePathOfTheSweepTurns) {
    toggleSwing(e_);
    EXPECT_FALSE(sweepOf(e_.explorer())) << "no sweep, nothing to turn";
    sweep(timeseries::SweepPath::Loop);
    toggleSwing(e_);
    EXPECT_EQ(sweepOf(e_.explorer())->path, timeseries::SweepPath::Swing);
    toggleSwing(e_);
    EXPECT_EQ(sweepOf(e_.explorer())->path, timeseries::SweepPath::Loop);
}

}  // namespace
}  // namespace app::headset
