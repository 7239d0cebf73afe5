#include "app/choices/sweep_edits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "app/choices/edits.h"
#include "app/choices/session.h"
#include "app/picture/picture.h"
#include "app/picture/resolved.h"
#include "tests/support/scenes.h"

namespace app {
namespace {

using timeseries::RangeSet;
using timeseries::SortedStep;

constexpr std::size_t kEdge = 20, kPoints = kEdge * kEdge * kEdge;

double unit(std::size_t i) {
    std::mt19937 random(static_cast<unsigned>(i));
    return static_cast<double>(random()) / 4294967296.0;
}
// Fields as files have them: mostly background, and all else.
double plume(std::size_t i) { return unit(i) < 0.9 ? 20 + unit(i) : 300 + 1000 * unit(2 * i); }
double even(std::size_t i) { return unit(i); }
double outliers(std::size_t i) { return i % 4000 == 0 ? 1e6 : unit(i); }
double classes(std::size_t i) { return i % 10 == 0 ? 1 : i % 100 == 1 ? 2 : 0; }
double normal(std::size_t i) {
    return std::sqrt(-2 * std::log(unit(i) + 1e-12)) * std::cos(6.283185 * unit(7 * i + 1));
}

std::uint64_t inWindow(const Explorer& e, double (*value)(std::size_t), std::int64_t tick) {
    const timeseries::Range window = timeseries::ValueSweep(*sweepOf(e)).window(tick);
    std::uint64_t points = 0;
    for (std::size_t i = 0; i < kPoints; ++i) {
        const auto v = static_cast<double>(static_cast<float>(value(i)));
        if (v >= static_cast<double>(static_cast<float>(std::get<double>(window.lo.value))) &&
            v <= static_cast<double>(static_cast<float>(std::get<double>(window.hi.value))))
            ++points;
    }
    return points;
}

Extent extentOf(const SortedStep& step) {
    return {timeseries::toDouble(step.statistics().min),
            timeseries::toDouble(step.statistics().max)};
}

TEST(StartSweep, BeginsOnSomethingThatIsSeenAndNotOnAll) {
    for (double (*value)(std::size_t) : {plume, even, outliers, classes, normal}) {
        const SortedStep step = tests::stepOf(tests::cube(kEdge), value);
        for (const char* layer : {"min:max", "0.5:0.9", "900:max", "5000:6000"}) {
            Explorer e;
            e.layers = {{RangeSet::parse(layer), glm::dvec3(1), 0.5}};
            startSweep(e, extentOf(step), step, true);
            const std::uint64_t points = inWindow(e, value, e.play.tick);
            EXPECT_GT(points, 0u) << layer;
            EXPECT_LE(points, kFirstShare * kPoints) << layer;
            EXPECT_FALSE(needsSamples(e));
        }
    }
}

TEST(StartSweep, BeginsNearWhatIsShown) {
    const SortedStep step = tests::stepOf(tests::cube(kEdge), plume);
    Explorer e;
    e.layers = {{RangeSet::parse("900:1000"), glm::dvec3(1), 0.5}};
    startSweep(e, extentOf(step), step, true);
    const double contour = timeseries::ValueSweep(*sweepOf(e)).contour(e.play.tick);
    EXPECT_GE(contour, 900);
    EXPECT_LE(contour, 1000);
}

TEST(StartSweep, AConstantFieldIsSweptToo) {
    const SortedStep step = tests::stepOf(tests::cube(4), [](std::size_t) { return 7.0; });
    Explorer e;
    startSweep(e, extentOf(step), step, true);
    EXPECT_EQ(step.count(rangesAt(e.layers.front(), step, e.play.tick)), 64u)
        << "there is nothing else";
}

TEST(StartSweep, WhatPlaysStaysAsItWasChosen) {
    const SortedStep step = tests::stepOf(tests::cube(kEdge), even);
    const auto moves = [&](bool time, bool sweep, bool timePlays) {
        Explorer e;
        e.play.timeMoves = time;
        e.play.sweepMoves = sweep;
        startSweep(e, extentOf(step), step, timePlays);
        return std::pair(e.play.timeMoves, e.play.sweepMoves);
    };
    EXPECT_EQ(moves(true, true, true), std::pair(true, false)) << "time alone played before";
    EXPECT_EQ(moves(false, true, true), std::pair(false, true));
    EXPECT_EQ(moves(true, true, false), std::pair(true, true)) << "time cannot play";
}

TEST(StartSweep, TakenBackLeavesTheLayersAsTheyWere) {
    const SortedStep step = tests::stepOf(tests::cube(kEdge), even);
    Explorer e;
    e.layers = {{RangeSet::parse("0:1"), glm::dvec3(1), 0.5}};
    const Explorer before = e;
    startSweep(e, extentOf(step), step, true);
    removeLayer(e, 0);
    EXPECT_EQ(e.layers, before.layers);
    EXPECT_FALSE(e.noLayers);
    e.layers.clear();
    startSweep(e, extentOf(step), step, true);
    removeLayer(e, 0);
    EXPECT_FALSE(needsSamples(e)) << "no first choice";
    const std::map<std::size_t, std::shared_ptr<const SortedStep>> none;
    EXPECT_TRUE(resolved(e, none).layers.empty());
    EXPECT_TRUE(fromJson(toJson(e, "/"), "/").layers.empty());
    EXPECT_FALSE(needsSamples(fromJson(toJson(e, "/"), "/")));
}

// Else nothing would be left to play.
TEST(StartSweep, TakenBackWhereValuesAlonePlayedLeavesTimeToPlay) {
    const SortedStep step = tests::stepOf(tests::cube(kEdge), even);
    Explorer e;
    startSweep(e, extentOf(step), step, true);
    e.layers.push_back({RangeSet::parse("0:1"), glm::dvec3(1), 0.5});
    e.play.timeMoves = false;
    removeLayer(e, 1);
    EXPECT_FALSE(e.play.timeMoves);
    removeLayer(e, 0);
    EXPECT_TRUE(e.play.timeMoves);
}

}  // namespace
}  // namespace app
