// What plays, as the page says and chooses it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/panels/focus.h"
#include "app/panels/widgets.h"
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

TEST(AnimationPage, NumbersGoBelowTheirChoicesWhereTheColumnIsNarrow) {
    const glm::vec2 window(500, 900);
    tests::PanelsDesk desk(tests::World{}, window);
    desk.frames(2);
    const Rect page = sideLayout(layoutOf(window, 1), 1).page;
    std::vector<Rect> places;
    for (const Focus::Control& c : focus().controls())
        if (page.holds(c.at.centre())) places.push_back(c.at);
    ASSERT_GE(places.size(), 5u);  // play, pace, speed, way, stride
    for (const std::size_t number : {2u, 4u})
        EXPECT_GE(places[number].min.y, places[number - 1].max.y);
}

TEST(Segments, HaveRoomForTheirLabelsWhereAllHaveIt) {
    const tests::PanelsDesk desk;
    constexpr std::array kEyes = {"One", "Side by side", "Top, bottom"};
    float sum = 0;
    for (const char* label : kEyes) sum += widthOf(*desk.theme().small, label);
    const Rect at{{0, 0}, {std::ceil(sum) + 18, 28}};
    ASSERT_GT(segmentsWidth(desk.theme(), kEyes), at.max.x);
    const std::vector<Rect> cells = segments(desk.theme(), at, kEyes);
    for (std::size_t i = 0; i < kEyes.size(); ++i)
        EXPECT_GE(cells[i].size().x, widthOf(*desk.theme().small, kEyes[i]) + 4) << kEyes[i];
    EXPECT_EQ(cells.back().max.x, at.max.x);
}

}  // namespace
}  // namespace app::panels
