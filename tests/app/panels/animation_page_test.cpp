// What plays, as the page says and chooses it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/panels/focus.h"
#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

// The middle of Time, Values and Both: the first of the page's controls.
glm::vec2 values(tests::PanelsDesk& desk) {
    const Rect page = sideLayout(desk.layout(), 1).page;
    const auto first = std::ranges::find_if(
        focus().controls(), [&](const Focus::Control& c) { return page.holds(c.at.centre()); });
    return first->at.centre();
}

TEST(AnimationPage, ValuesOfOneStepAreSweptWhenTheyAreToPlay) {
    tests::PanelsDesk desk(tests::World{.steps = 1});
    desk.frames(2);
    ASSERT_FALSE(sweepOf(desk.exploration.explorer()));
    desk.click(values(desk));
    EXPECT_TRUE(sweepOf(desk.exploration.explorer()));
    desk.exploration.togglePlay();
    EXPECT_TRUE(desk.exploration.playback().playing);
}

TEST(AnimationPage, WhatHasNothingToPlayIsToldOfTheSweep) {
    tests::PanelsDesk desk(tests::World{.steps = 1});
    desk.exploration.togglePlay();
    ASSERT_FALSE(desk.exploration.messages().empty());
    EXPECT_THAT(desk.exploration.messages().back().text,
                testing::AllOf(testing::HasSubstr("one step"), testing::HasSubstr("Sweep values")));
    desk.exploration.forgetMessage(desk.exploration.messages().back().number);
    desk.sweep("0:64", 2);
    Explorer still = desk.exploration.explorer();
    sweepOf(still)->frequency = 0;
    desk.exploration.edit(still);
    desk.exploration.togglePlay();
    ASSERT_FALSE(desk.exploration.messages().empty());
    EXPECT_THAT(desk.exploration.messages().back().text, testing::EndsWith("the speed is 0"));
}

}  // namespace
}  // namespace app::panels
