#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "app/panels/time_bar.h"

namespace app {
namespace {

TEST(Pace, RealTimesFirstTakeAsLongAsEvenOnes) {
    using timeseries::Pace;
    // Monthly, in hours: 720 an hour's length, ten steps a second.
    timeseries::TimeAxis months{"time", "hours since 2000-01-01", "standard", {}};
    for (int i = 0; i < 12; ++i) months.points.push_back({720.0 * i, ""});
    timeseries::CursorSettings time{.stepsPerSecond = 10};
    EXPECT_EQ(panels::speedUnit(time, months), "steps/s");
    panels::setPace(time, Pace::RealTimes, months);
    EXPECT_EQ(time.pace, Pace::RealTimes);
    EXPECT_NEAR(time.timeUnitsPerSecond, 7200, 7200 / 50);
    EXPECT_EQ(panels::speedUnit(time, months), "h/s");
    EXPECT_EQ(panels::speedUnit(time, {"t", "seconds since 1900-01-01", "", months.points}), "s/s");
    EXPECT_EQ(panels::speedUnit(time, {"t", "months", "", months.points}), "months/s");
    EXPECT_EQ(panels::speedUnit(time, {"cycle", "", "", months.points}), "units/s");
    // One that was chosen stays.
    time.timeUnitsPerSecond = 24;
    panels::setPace(time, Pace::Even, months);
    panels::setPace(time, Pace::RealTimes, months);
    EXPECT_EQ(time.timeUnitsPerSecond, 24);
    // Nothing is to be had from one time, or from times that do not go on.
    for (const auto& points : {std::vector<timeseries::TimePoint>{{5, ""}},
                               {{5, ""}, {5, ""}},
                               {{5, ""}, {std::nan(""), ""}}}) {
        timeseries::CursorSettings still;
        panels::setPace(still, Pace::RealTimes, {"time", "s", "", points});
        EXPECT_EQ(still.timeUnitsPerSecond, timeseries::CursorSettings().timeUnitsPerSecond);
    }
}

}  // namespace
}  // namespace app
