// What runtimes predict and tell in, the display's own period out.
#include "xr/display_period.h"

#include <gtest/gtest.h>

#include <cmath>

namespace xr {
namespace {

using namespace std::chrono_literals;

TEST(DisplayPeriod, IsTheLeastOneThatWasPredicted) {
    DisplayPeriod period;
    EXPECT_EQ(period.now(), 0ns) << "nothing is known";
    period.predicted(100ms);
    EXPECT_EQ(period.now(), 100ms);
    period.predicted(50ms);
    for (int slow = 1; slow < 10; ++slow) period.predicted(slow * 50ms);
    EXPECT_EQ(period.now(), 50ms) << "a slow program's frames are predicted to last longer";
}

TEST(DisplayPeriod, IsThatOfTheRateWhereTheRuntimeTellsIt) {
    DisplayPeriod period;
    period.predicted(30ms);
    period.told(50);
    EXPECT_EQ(period.now(), 20ms);
    period.predicted(15ms);
    EXPECT_EQ(period.now(), 20ms);
    period.told(100);
    EXPECT_EQ(period.now(), 10ms);
}

TEST(DisplayPeriod, WhatNoDisplayHasIsPassedOver) {
    DisplayPeriod period;
    period.predicted(20ms);
    for (const auto none : {0ns, -5'000'000ns, 3000ns, 5'000'000'000ns}) period.predicted(none);
    for (const double none : {0.0, -60.0, 1e9, std::nan(""), double{INFINITY}}) period.told(none);
    EXPECT_EQ(period.now(), 20ms);
}

TEST(DisplayPeriod, IsLearntAnewForAnotherRate) {
    DisplayPeriod period;
    period.predicted(10ms);
    period.told(100);
    period.forget();
    period.predicted(20ms);
    EXPECT_EQ(period.now(), 20ms);
}

}  // namespace
}  // namespace xr
