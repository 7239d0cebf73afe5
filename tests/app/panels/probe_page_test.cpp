// What is said of points that were read.
#include "app/panels/probe_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/scripted_exploration.h"

namespace app::panels {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(ProbePage, SaysOfPointsThatWereReadAtOtherTimesThatTheyWere) {
    tests::ScriptedExploration desk;
    const Shown shown = *desk.exploration.shown();
    const auto at = [&](std::size_t step) { return timeText(*shown.dataset.variable.time, step); };
    const auto said = [&](std::size_t first, std::optional<std::size_t> second) {
        Reading from, to;
        from.step = first;
        to.step = second.value_or(0);
        return timesNote(from, second ? &to : nullptr, shown);
    };
    const std::size_t now = shown.step;
    const auto ofPicture = HasSubstr("not at the picture's, " + at(now));
    const auto ofFirst = [&](std::size_t step) {
        return HasSubstr("at another time, " + at(step));
    };
    EXPECT_EQ(said(now, {}), "");
    EXPECT_EQ(said(now, now), "");
    EXPECT_THAT(said(now + 1, {}), AllOf(ofPicture, Not(HasSubstr("another time"))));
    EXPECT_THAT(said(now + 1, now + 1), AllOf(ofPicture, Not(HasSubstr("another time"))));
    EXPECT_THAT(said(now + 1, now), AllOf(ofFirst(now + 1), Not(HasSubstr("picture"))));
    EXPECT_THAT(said(now, now + 1), AllOf(ofPicture, ofFirst(now)));
}

TEST(ProbePage, MeasuresPlacesOfTheEarthByTheGreatCircle) {
    constexpr double kAround = 2 * std::numbers::pi * 6371.0088;
    EXPECT_NEAR(kilometresApart({0, 0, 5}, {90, 0, 700}), kAround / 4, 1e-8);
    EXPECT_NEAR(kilometresApart({10, -30, 0}, {10, 60, 0}), kAround / 4, 1e-8);
    EXPECT_NEAR(kilometresApart({-170, 80, 0}, {10, 80, 0}), kAround / 18, 1e-8);
    EXPECT_NEAR(kilometresApart({359.5, 0, 0}, {0.5, 0, 0}), kAround / 360, 1e-8);
    EXPECT_NEAR(kilometresApart({20, 40, 0}, {200, -40, 0}), kAround / 2, 1e-3);
    EXPECT_EQ(kilometresApart({20, 40, 0}, {20, 40, 9}), 0);
}

}  // namespace
}  // namespace app::panels
