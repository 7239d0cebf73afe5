#include "timeseries/series/value_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

namespace timeseries {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

SweepSettings settings(const char* ranges, SweepPath path = SweepPath::Loop) {
    return {.animation = RangeSet::parse(ranges), .path = path};
}

double value(const Bound& bound) { return std::get<double>(bound.value); }

// The fraction of the way at count q of T timer steps, as the header states it.
double fractionOf(std::int64_t q, std::int64_t T, SweepPath path) {
    if (T == 1) return 0;
    if (path == SweepPath::Loop) return static_cast<double>(q) / static_cast<double>(T - 1);
    return (1 - std::cos(2 * std::numbers::pi * static_cast<double>(q) / static_cast<double>(T))) /
           2;
}

TEST(ValueSweep, LoopCountsLinearlyFromTheLeastValueToTheGreatest) {
    const ValueSweep sweep(settings("10:265"));
    ASSERT_EQ(sweep.ticksPerCycle(), 256);
    for (std::int64_t q = 0; q < 256; ++q)
        EXPECT_NEAR(sweep.contour(q), 10 + static_cast<double>(q), 1e-10) << "count " << q;
    EXPECT_EQ(sweep.contour(0), 10);
    EXPECT_EQ(sweep.contour(255), 265);
}

TEST(ValueSweep, SwingFollowsTheCosine) {
    const ValueSweep sweep(settings("-2:6", SweepPath::Swing));
    for (std::int64_t q = 0; q < 256; ++q) {
        const double phase = static_cast<double>(q) / 256;
        EXPECT_NEAR(sweep.contour(q), -2 + 8 * (1 - std::cos(2 * std::numbers::pi * phase)) / 2,
                    1e-12);
    }
    EXPECT_EQ(sweep.contour(0), -2);
    EXPECT_EQ(sweep.contour(128), 6);
}

TEST(ValueSweep, SwingIsTheSameThereAndBack) {
    SweepSettings s = settings("0.1:0.7,3:11", SweepPath::Swing);
    for (const std::int64_t T : {2, 7, 256, 1000}) {
        s.timerSteps = T;
        const ValueSweep sweep(s);
        for (std::int64_t q = 1; q < T; ++q)
            EXPECT_EQ(sweep.contour(q), sweep.contour(T - q)) << q << " of " << T;
    }
}

TEST(ValueSweep, SwingMovesNoFurtherInAStepThanTheSteepestPartOfTheCosine) {
    SweepSettings s = settings("0:1", SweepPath::Swing);
    s.step = 7;  // does not divide 256: the last count to the first is part of the circle too
    const ValueSweep sweep(s);
    const std::int64_t n = sweep.ticksPerCycle();
    const double steepest = std::numbers::pi * 7.0 / 256;  // max |d/dq sin^2(pi q / T)| = pi / T
    for (std::int64_t i = 0; i < n; ++i)
        EXPECT_LE(std::abs(sweep.contour((i + 1) % n) - sweep.contour(i)), steepest)
            << "tick " << i;
}

TEST(ValueSweep, TheStepTakesEveryKthCountAndTheCycleLastsAsLong) {
    SweepSettings s = settings("0:255");
    s.frequency = 0.5;
    for (const std::int64_t K : {1, 2, 3, 8, 100, 255, 256, 1000}) {
        s.step = K;
        const ValueSweep sweep(s);
        std::int64_t counts = 0;
        for (std::int64_t q = 0; q < 256; q += K, ++counts)
            EXPECT_NEAR(sweep.contour(counts), static_cast<double>(q), 1e-10) << "step " << K;
        EXPECT_EQ(sweep.ticksPerCycle(), counts) << "step " << K;
        EXPECT_EQ(sweep.cycle(), nanoseconds(2s)) << "step " << K;
    }
}

TEST(ValueSweep, ThePapersExampleRedrawsSixteenTimesASecond) {
    // Crawfis 1996: "a Step of 8 and a frequency of 0.5 will try to update and redraw 16 times a
    // second".
    SweepSettings s = settings("0:1");
    s.step = 8;
    s.frequency = 0.5;
    ValueSweep sweep(s);
    for (std::int64_t tick = 0; tick < 100; ++tick) {
        EXPECT_EQ(sweep.tick(), tick % 32);
        EXPECT_EQ(sweep.untilNextTick(), nanoseconds(1s) / 16);
        sweep.advance(nanoseconds(1s) / 16);
    }
}

TEST(ValueSweep, TheCentreIsNeverInAGap) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int round = 0; round < 300; ++round) {
        const double scale = std::pow(10.0, 300 * unit(random));
        std::vector<Range> ranges;
        for (int i = 0; i < 1 + round % 5; ++i) {
            const double a = scale * unit(random), b = scale * unit(random);
            ranges.push_back({{std::min(a, b), round % 2 == 0}, {std::max(a, b), round % 3 == 0}});
        }
        SweepSettings s{.animation = RangeSet(ranges)};
        s.timerSteps = 1 + static_cast<std::int64_t>(random() % 300);
        s.step = 1 + static_cast<std::int64_t>(random() % 9);
        s.path = round % 2 ? SweepPath::Loop : SweepPath::Swing;
        const ValueSweep sweep(s);
        for (std::int64_t tick = 0; tick < sweep.ticksPerCycle(); ++tick) {
            const double c = sweep.contour(tick);
            bool inside = false;
            for (const Range& r : s.animation.ranges()) {
                const double lo = value(r.lo), hi = value(r.hi);
                inside |= (r.lo.open ? c > lo : c >= lo) && (r.hi.open ? c < hi : c <= hi);
            }
            EXPECT_TRUE(inside) << c << " at tick " << tick << " of " << s.animation.text();
        }
    }
}

TEST(ValueSweep, GapsTakeNoTime) {
    // 10 + 30 + 60 of length: a tenth, three tenths, six tenths of the 1000 counts.
    SweepSettings s = settings("0:10,1000:1030,-500:-440");
    s.timerSteps = 1001;
    const ValueSweep sweep(s);
    for (std::int64_t q = 0; q <= 1000; ++q) {
        const double way = static_cast<double>(q) / 10;
        const double expected = way <= 60 ? -500 + way : way <= 70 ? way - 60 : 1000 + way - 70;
        if (q == 600 || q == 700)
            continue;  // the end of one range and the start of the next are one
        EXPECT_NEAR(sweep.contour(q), expected, 1e-9) << "count " << q;
    }
}

TEST(ValueSweep, SingleValuesAloneAreShownInTurn) {
    SweepSettings s = settings("1,5,9");
    s.timerSteps = 6;
    const ValueSweep sweep(s);
    // Fractions 0, .2, .4, .6, .8, 1 of three values.
    const double expected[] = {1, 1, 5, 5, 9, 9};
    for (std::int64_t q = 0; q < 6; ++q) EXPECT_EQ(sweep.contour(q), expected[q]) << "count " << q;
}

TEST(ValueSweep, ARangeOfOneValueStaysThere) {
    const ValueSweep sweep(settings("42", SweepPath::Swing));
    for (std::int64_t q = 0; q < sweep.ticksPerCycle(); ++q) EXPECT_EQ(sweep.contour(q), 42);
}

TEST(ValueSweep, TheWindowIsTheCentreAndDeltaBothSidesUnclipped) {
    SweepSettings s = settings("0:255");
    s.delta = 3;
    const ValueSweep sweep(s);
    for (std::int64_t tick : {0, 100, 255}) {
        const Range w = sweep.window(tick);
        EXPECT_EQ(value(w.lo), sweep.contour(tick) - 3);
        EXPECT_EQ(value(w.hi), sweep.contour(tick) + 3);
        EXPECT_FALSE(w.lo.open || w.hi.open);
    }
}

TEST(ValueSweep, TheWidestRangeAndDeltaStayFinite) {
    constexpr double kMost = std::numeric_limits<double>::max();
    SweepSettings s{.animation = RangeSet({Range{{-kMost}, {kMost}}}), .delta = kMost};
    const ValueSweep sweep(s);
    EXPECT_EQ(sweep.contour(0), -kMost);
    EXPECT_EQ(sweep.contour(128), kMost);
    for (std::int64_t q = 0; q < 256; ++q) {
        EXPECT_TRUE(std::isfinite(value(sweep.window(q).lo))) << q;
        EXPECT_TRUE(std::isfinite(value(sweep.window(q).hi))) << q;
    }
}

TEST(ValueSweep, ATableOfAsManyEntriesAsTimerStepsIsReadOnceThrough) {
    const ValueSweep sweep(settings("3:4"));
    for (std::int64_t q = 0; q < 256; ++q) EXPECT_EQ(std::lround(sweep.tablePosition(q) * 255), q);
}

TEST(ValueSweep, TheTableFollowsTheSwing) {
    const ValueSweep sweep(settings("0:1", SweepPath::Swing));
    for (std::int64_t q = 0; q < 256; ++q)
        EXPECT_NEAR(sweep.tablePosition(q), sweep.contour(q), 1e-15);
}

TEST(ValueSweep, RandomSettingsFollowTheClosedForm) {
    std::mt19937_64 random(11);
    for (int round = 0; round < 500; ++round) {
        SweepSettings s = settings("-1:3", round % 2 ? SweepPath::Loop : SweepPath::Swing);
        s.timerSteps = 1 + static_cast<std::int64_t>(random() % 500);
        s.step = 1 + static_cast<std::int64_t>(random() % 40);
        s.frequency = std::ldexp(1.0, static_cast<int>(random() % 20) - 12);
        ValueSweep sweep(s);
        const auto elapsed = nanoseconds(random() >> 4);
        sweep.advance(elapsed);
        // A cycle of a power of two per second is exact in double, but not in nanoseconds.
        const std::int64_t P =
            std::max<std::int64_t>(std::llround(1e9 / s.frequency), sweep.ticksPerCycle());
        __extension__ using Wide = __int128;
        const auto tick =
            static_cast<std::int64_t>(Wide{elapsed.count() % P} * sweep.ticksPerCycle() / P);
        ASSERT_EQ(sweep.tick(), tick) << "T " << s.timerSteps << " K " << s.step << " F "
                                      << s.frequency << " elapsed " << elapsed.count();
        EXPECT_NEAR(sweep.contour(), -1 + 4 * fractionOf(tick * s.step, s.timerSteps, s.path),
                    1e-12);
    }
}

TEST(ValueSweep, ManyAdvancesAreOneAdvance) {
    std::mt19937_64 random(13);
    for (int round = 0; round < 200; ++round) {
        SweepSettings s = settings("0:1");
        s.timerSteps = 1 + static_cast<std::int64_t>(random() % 300);
        s.step = 1 + static_cast<std::int64_t>(random() % 7);
        s.frequency = static_cast<double>(random() % 100000) / 977;
        ValueSweep parts(s);
        parts.seek(static_cast<std::int64_t>(random() >> 8) % parts.ticksPerCycle());
        ValueSweep whole = parts;
        nanoseconds sum{0};
        for (int i = 0; i < 50; ++i) {
            const nanoseconds dt(random() >> (20 + random() % 40));
            parts.advance(dt);
            sum += dt;
        }
        whole.advance(sum);
        EXPECT_EQ(parts, whole) << "T " << s.timerSteps << " K " << s.step << " F " << s.frequency;
    }
}

TEST(ValueSweep, HugeElapsedTimesStayInTheCycle) {
    SweepSettings s = settings("0:1");
    s.frequency = 1e6;
    ValueSweep sweep(s);
    for (int i = 0; i < 3; ++i) {
        sweep.advance(nanoseconds::max());
        EXPECT_GE(sweep.tick(), 0);
        EXPECT_LT(sweep.tick(), sweep.ticksPerCycle());
    }
    // Three times 2^63 - 1 in a cycle of 1000 ns.
    const auto rest = static_cast<std::int64_t>(((~0ull >> 1) % 1000) * 3 % 1000);
    EXPECT_EQ(sweep.tick(), rest * 256 / 1000);
}

TEST(ValueSweep, NoFrequencyStandsStill) {
    SweepSettings s = settings("0:1");
    s.frequency = 0;
    ValueSweep sweep(s, {.tick = 17, .into = nanoseconds(0)});
    sweep.advance(1000h);
    EXPECT_EQ(sweep.tick(), 17);
    EXPECT_EQ(sweep.cycle(), std::nullopt);
    EXPECT_EQ(sweep.untilNextTick(), std::nullopt);
}

TEST(ValueSweep, AnExcessiveFrequencyIsATickANanosecond) {
    SweepSettings s = settings("0:1");
    s.frequency = 1e300;
    ValueSweep sweep(s);
    EXPECT_EQ(sweep.cycle(), nanoseconds(256));
    sweep.advance(3ns);
    EXPECT_EQ(sweep.tick(), 3);
}

TEST(ValueSweep, TimeThatGoesBackCountsAsNone) {
    ValueSweep sweep(settings("0:1"), {.tick = 5, .into = 7ns});
    const ValueSweep before = sweep;
    sweep.advance(-1h);
    EXPECT_EQ(sweep, before);
}

TEST(ValueSweep, AStepAsLargeAsTheTimerHasOneTick) {
    SweepSettings s = settings("3:4", SweepPath::Swing);
    s.step = 256;
    ValueSweep sweep(s);
    sweep.advance(12345s);
    EXPECT_EQ(sweep.ticksPerCycle(), 1);
    EXPECT_EQ(sweep.contour(), 3);
    EXPECT_EQ(sweep.untilNextTick(), std::nullopt);
}

TEST(ValueSweep, WaitingUntilTheNextTickChangesIt) {
    SweepSettings s = settings("0:1");
    s.frequency = 0.3;
    s.step = 5;
    ValueSweep sweep(s);
    for (int i = 0; i < 200; ++i) {
        ValueSweep early = sweep;
        early.advance(*sweep.untilNextTick() - 1ns);
        EXPECT_EQ(early.tick(), sweep.tick());
        early.advance(1ns);
        EXPECT_EQ(early.tick(), (sweep.tick() + 1) % sweep.ticksPerCycle());
        sweep = early;
    }
}

TEST(ValueSweep, ANewFrequencyKeepsTheTick) {
    SweepSettings s = settings("0:1");
    ValueSweep sweep(s);
    for (int i = 0; i < 1000; ++i) {
        sweep.advance(nanoseconds(7'654'321));
        const std::int64_t tick = sweep.tick();
        s.frequency = i % 10 == 0 ? 0 : 0.01 * i;
        sweep.set(s);
        ASSERT_EQ(sweep.tick(), tick) << "frequency " << s.frequency;
    }
}

TEST(ValueSweep, ANewTimerKeepsTheFractionOfTheWay) {
    SweepSettings s = settings("0:1");
    ValueSweep sweep(s);
    sweep.seek(64);
    s.timerSteps = 1024;
    s.step = 4;
    sweep.set(s);
    EXPECT_EQ(sweep.tick(), 64);  // count 256 of 1024, by fours
}

TEST(ValueSweep, WhatASessionStoresComesBackEqual) {
    ValueSweep sweep(settings("0:1,2:3", SweepPath::Swing));
    sweep.advance(12'345'678'901ns);
    EXPECT_EQ(ValueSweep(sweep.settings(), sweep.position()), sweep);
}

TEST(ValueSweep, APositionOutsideTheCycleIsBroughtInside) {
    const ValueSweep sweep(settings("0:1"), {.tick = 1000, .into = 1h});
    EXPECT_EQ(sweep.tick(), 255);
    EXPECT_EQ(sweep.untilNextTick(), 1ns);
    EXPECT_EQ(ValueSweep(settings("0:1"), {.tick = -3, .into = -1h}), ValueSweep(settings("0:1")));
}

TEST(ValueSweep, RefusesWhatCannotBeSwept) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_THROW(ValueSweep(settings("min:3")), std::invalid_argument);
    EXPECT_THROW(ValueSweep(settings("0:1,3:max")), std::invalid_argument);
    EXPECT_THROW(ValueSweep(SweepSettings{}), std::invalid_argument);
    const auto refused = [](auto change) {
        SweepSettings s = settings("0:1");
        change(s);
        EXPECT_THROW((ValueSweep(s)), std::invalid_argument);
        ValueSweep sweep(settings("0:1"));
        const ValueSweep before = sweep;
        EXPECT_THROW(sweep.set(s), std::invalid_argument);
        EXPECT_EQ(sweep, before);
    };
    for (const double bad : {-1.0, nan, inf}) {
        refused([&](SweepSettings& s) { s.delta = bad; });
        refused([&](SweepSettings& s) { s.frequency = bad; });
    }
    for (const std::int64_t bad : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1} << 31}) {
        refused([&](SweepSettings& s) { s.timerSteps = bad; });
        refused([&](SweepSettings& s) { s.step = bad; });
    }
}

}  // namespace
}  // namespace timeseries
