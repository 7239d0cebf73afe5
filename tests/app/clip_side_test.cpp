// A side of the clip box as a field tells it and reads it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/choices/choice_text.h"
#include "app/choices/edits.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace app {
namespace {

TEST(ClipSide, IsReadAsItIsTyped) {
    timeseries::Axis down = tests::axis(5, 10);  // 10 to 14
    std::ranges::reverse(down.coordinates);
    timeseries::Axis stored = tests::axis(4, 0, 0.1f);  // 0 to 0.30000000447...
    const timeseries::Grid grid(std::array{tests::axis(5), down, stored});
    const auto typed = [&](std::string_view text, std::size_t axis = 0,
                           const std::optional<ClipBox>& clip = {}) {
        const auto box = withClipSide(clip, grid, axis, text);
        return box ? clipText(*box) : "none";
    };
    EXPECT_EQ(typed("1.5:3"), "1.5:3,min:max,min:max");
    EXPECT_EQ(typed("min:3"), "min:3,min:max,min:max");
    EXPECT_EQ(typed("11:12.5", 1, parseClip("1.5:3,min:max,min:max")), "1.5:3,11:12.5,min:max");
    for (const char* all : {"", "  ", "min:max", "0:4", "-9:9"})
        EXPECT_TRUE(typed(all) == "none" || typed(all) == "-9:9,min:max,min:max") << all;
    EXPECT_EQ(typed("", 0, parseClip("1.5:3,11:12,min:max")), "min:max,11:12,min:max");
    // A slice: the plane that is nearest.
    EXPECT_EQ(typed("2.4"), "2:2,min:max,min:max");
    EXPECT_EQ(typed("2.6"), "3:3,min:max,min:max");
    EXPECT_EQ(typed("14", 1), "min:max,14:14,min:max");
    // The last plane is not lost to the digits that its end was told with.
    ASSERT_GT(stored.coordinates.back(), 0.3);
    EXPECT_EQ(clipSideText({}, grid, 2), "0:0.3");
    EXPECT_EQ(typed("0.1:0.3", 2), "min:max,min:max,0.1:max");
}

// 0.1 as a float is a little more than it is told to be.
TEST(ClipSide, ASliceAtAnEndOfTheAxisIsReadAsItIsShown) {
    const timeseries::Axis stored = tests::axis(3, 0.1f, 0.1f);
    const timeseries::Grid grid(std::array{stored, tests::axis(5), tests::axis(5)});
    ASSERT_GT(stored.coordinates.front(), 0.1);
    const auto box = withClipSide({}, grid, 0, "0.1");
    ASSERT_TRUE(box);
    EXPECT_EQ(box->lo.x, stored.coordinates.front());
    EXPECT_EQ(box->hi.x, stored.coordinates.front());
    // With few digits 1234 is 1.23e+03.
    const timeseries::Grid far(
        std::array{tests::axis(3, 1234, 100), tests::axis(5), tests::axis(5)});
    const auto slice = withClipSide({}, far, 0, "1234");
    EXPECT_EQ(withClipSide(slice, far, 0, clipSideText(slice, far, 0, 3), 3), slice);
}

TEST(ClipSide, WhatCannotBeIsRefusedInASentence) {
    const timeseries::Grid grid(std::array{tests::axis(5), tests::axis(5), tests::axis(5)});
    for (const auto& [text, says] :
         {std::pair("abc", "abc"), std::pair("1:2,3:4", "one range"), std::pair("[1,2)", "closed"),
          std::pair("1.2:1.8", "x, from 0 to 4"), std::pair("5:9", "x, from 0 to 4"),
          std::pair("5", "x, from 0 to 4 m, has none from 5 to 5"),
          std::pair("-0.3", "x, from 0 to 4")}) {
        try {
            withClipSide({}, grid, 0, text);
            ADD_FAILURE() << text;
        } catch (const ChoiceError& error) {
            EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
        }
    }
}

TEST(ClipSide, OfAMeshIsARangeOfCoordinates) {
    const auto mesh = tests::curvilinear(
        {5, 5, 5}, [](double i, double j, double k) { return glm::dvec3(i + 0.1 * j, j, k); });
    const auto box = withClipSide({}, *mesh, 0, "1.03:2.04");
    ASSERT_TRUE(box);
    EXPECT_EQ(box->lo.x, 1.03);
    EXPECT_EQ(box->hi.x, 2.04);
    try {
        withClipSide({}, *mesh, 0, "2");
        ADD_FAILURE() << "a plane";
    } catch (const ChoiceError& error) {
        EXPECT_NE(std::string(error.what()).find("lie in no plane"), std::string::npos);
    }
}

TEST(ClipSide, ReadsBackWhatItShows) {
    const timeseries::Grid grid(std::array{tests::axis(9), tests::axis(9, -4), tests::axis(9)});
    std::mt19937 random(3);
    for (int i = 0; i < 200; ++i) {
        const std::size_t axis = random() % 3;
        const double from = axis == 1 ? -4 : 0;
        const int a = static_cast<int>(random() % 9), b = static_cast<int>(random() % 9);
        const auto box = withClipSide(
            {}, grid, axis, fmt::format("{}:{}", from + std::min(a, b), from + std::max(a, b)));
        EXPECT_EQ(withClipSide(box, grid, axis, clipSideText(box, grid, axis)), box);
    }
}

// As wide as a letter each.
TEST(ClipSide, IsShownWithAsManyDigitsAsThereIsRoomFor) {
    const timeseries::Grid grid(
        std::array{tests::axis(60, -0.4916667, 1.0 / 60), tests::axis(5, 1234567), tests::axis(3)});
    const auto shown = [&](std::size_t axis, std::size_t room,
                           const std::optional<ClipBox>& clip = {}) {
        const auto fits = [&](std::string_view text) { return text.size() <= room; };
        return clipSideText(clip, grid, axis, clipDigits(clip, grid, axis, fits));
    };
    EXPECT_EQ(shown(0, 20), "-0.4916667:0.4916666");
    EXPECT_EQ(shown(0, 19), "-0.491667:0.491667");
    EXPECT_EQ(shown(0, 14), "-0.4917:0.4917");
    EXPECT_EQ(shown(0, 1), "-0.492:0.492");
    EXPECT_EQ(shown(1, 1), "1234567:1234571") << "fewer would be one number";
    EXPECT_EQ(shown(2, 1), "0:2");
}

TEST(ClipSide, AnEndThatIsTypedAsItWasShownStays) {
    const timeseries::Grid grid(
        std::array{tests::axis(60, -0.4916667, 1.0 / 60), tests::axis(5), tests::axis(3)});
    const auto typed = [&](const std::optional<ClipBox>& clip, std::string_view text, int digits) {
        return withClipSide(clip, grid, 0, text, digits);
    };
    EXPECT_EQ(typed({}, "-0.492:0.492", 3), std::nullopt);
    EXPECT_EQ(typed({}, "-0.492:0.1", 3), parseClip("min:0.1,min:max,min:max"));
    const ClipBox box = parseClip("-0.123456789:0.123456789,min:max,min:max");
    EXPECT_EQ(typed(box, "-0.123:0.123", 3), box);
    EXPECT_EQ(typed(box, "-0.123:0.2", 3), parseClip("-0.123456789:0.2,min:max,min:max"));
    EXPECT_EQ(typed(box, "-0.1235:0.2", 3), parseClip("-0.1235:0.2,min:max,min:max"));
}

}  // namespace
}  // namespace app
