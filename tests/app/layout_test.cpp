#include "app/panels/layout.h"

#include <gtest/gtest.h>

#include <vector>

namespace app::panels {
namespace {

struct Size {
    glm::vec2 window;
    float scale;
    std::size_t layers;
};

class EveryLayout : public testing::TestWithParam<Size> {
 protected:
    const Layout layout_ = layoutOf(GetParam().window, GetParam().scale);
    const SideLayout side_ = sideLayout(layout_, GetParam().layers);
};

INSTANTIATE_TEST_SUITE_P(Sizes, EveryLayout,
                         testing::Values(Size{{1440, 900}, 1, 1}, Size{{1000, 700}, 1, 3},
                                         Size{{800, 640}, 1, 8}, Size{{1920, 1080}, 1.5f, 8},
                                         Size{{2880, 1800}, 2, 2}, Size{{3840, 2160}, 2, 0},
                                         Size{{1440, 900}, 2, 1}, Size{{1440, 900}, 2, 8},
                                         Size{{800, 640}, scaleWithRoom({800, 640}, 2), 1},
                                         Size{{800, 640}, scaleWithRoom({800, 640}, 2), 8},
                                         Size{{1000, 700}, scaleWithRoom({1000, 700}, 4), 2},
                                         Size{{1440, 640}, scaleWithRoom({1440, 640}, 4), 8}));

TEST_P(EveryLayout, PictureColumnAndBarFillTheWindowWithoutOverlap) {
    const auto area = [](const Rect& r) { return r.size().x * r.size().y; };
    EXPECT_EQ(
        area(layout_.picture) + area(layout_.status) + area(layout_.side) + area(layout_.timeBar),
        area(layout_.window));
    EXPECT_EQ(layout_.picture.max.x, layout_.side.min.x);
    EXPECT_EQ(layout_.status.max.x, layout_.side.min.x);
    EXPECT_EQ(layout_.picture.max.y, layout_.status.min.y);
    EXPECT_EQ(layout_.status.max.y, layout_.timeBar.min.y);
    EXPECT_GE(layout_.status.size().y,
              18 * layout_.scale * static_cast<float>(statusLines(layout_)));
    EXPECT_GT(layout_.picture.size().x, 0.4f * layout_.window.size().x);
}

TEST_P(EveryLayout, PartsOfTheColumnFollowEachOtherToItsEnd) {
    const std::vector<Rect> parts = {side_.header, side_.layers, side_.histogramPanel, side_.tabs,
                                     side_.page};
    float y = layout_.side.min.y;
    for (const Rect& part : parts) {
        EXPECT_NEAR(part.min.y, y, 1);
        EXPECT_GT(part.size().y, 30 * layout_.scale);
        y = part.max.y;
    }
    EXPECT_LE(y, layout_.side.max.y + 1);
    EXPECT_GT(y, layout_.side.max.y - 60 * layout_.scale);
}

TEST_P(EveryLayout, WhatIsPressedInARowDoesNotOverlap) {
    const LayerRowLayout row = layerRow(side_.layers, side_.layers.min.y, layout_.scale);
    const std::vector<Rect> parts = {row.swatch, row.text,   row.eye,
                                     row.remove, row.amount, row.opacity};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        EXPECT_GT(parts[i].size().x, 20 * layout_.scale) << i;
        EXPECT_GE(parts[i].min.x, layout_.side.min.x);
        EXPECT_LE(parts[i].max.x, layout_.side.max.x);
        for (std::size_t j = 0; j < i; ++j) {
            const bool apart = parts[i].min.x >= parts[j].max.x ||
                               parts[j].min.x >= parts[i].max.x ||
                               parts[i].min.y >= parts[j].max.y || parts[j].min.y >= parts[i].max.y;
            EXPECT_TRUE(apart) << i << " and " << j;
        }
    }
}

TEST_P(EveryLayout, TheRailHasRoomBetweenButtonsAndSettings) {
    const TimeBarLayout bar = timeBarLayout(layout_.timeBar, layout_.scale);
    EXPECT_GT(bar.rail.min.x, bar.now.max.x);
    EXPECT_LT(bar.rail.max.x, bar.ending.min.x);
    EXPECT_GT(bar.rail.size().x, 250 * layout_.scale);
    // A day and its hour, 19 characters of about 8 pixels.
    EXPECT_GT(bar.now.size().x, 19 * 8 * layout_.scale);
}

// The legend's lines reach down to three fifths of the picture; its notes are three lines.
TEST_P(EveryLayout, AnExportIsToldBetweenTheLegendAndTheNotes) {
    const Rect& picture = layout_.picture;
    const Rect place = exportPlace(picture, layout_.scale);
    EXPECT_GT(place.min.y, picture.min.y + 0.6f * picture.size().y);
    EXPECT_LT(place.max.y, picture.max.y - 3 * 18 * layout_.scale);
    EXPECT_LE(place.max.y, messagesBottom(picture, layout_.scale));
}

TEST(Layout, ASessionThatIsOfferedLeavesTheLegendFree) {
    for (float width = 320; width < 2000; width += 40)
        for (const glm::vec2 legend : {glm::vec2(0), {170, 90}, {240, 300}}) {
            const Rect picture{{7, 5}, {7 + width, 505}};
            const auto at = recoveryOfferLayout(picture, 1, legend);
            EXPECT_GE(at.whole.min.x, picture.min.x);
            EXPECT_LE(at.whole.max.y, picture.max.y);
            EXPECT_TRUE(at.whole.min.x + 1 >= picture.min.x + legend.x ||
                        at.whole.min.y >= picture.min.y + legend.y)
                << width;
            if (width > 900) {
                EXPECT_EQ(at.whole.min.y, picture.min.y + 14) << "beside it";
            }
            for (const Rect& button : {at.goOn, at.discard}) {
                EXPECT_TRUE(at.whole.holds(button.min) && at.whole.holds(button.max));
            }
        }
}

TEST(Layout, TheColumnKeepsItsWidthWithinLimits) {
    const glm::vec2 window(1440, 900);
    EXPECT_EQ(layoutOf(window, 1, 10).side.size().x, 320);
    EXPECT_EQ(layoutOf(window, 1, 500).side.size().x, 500);
    EXPECT_EQ(layoutOf(window, 1, 5000).side.size().x, 720);
}

// Behind the tabs the scale is chosen: a page has at least two rows of its form, and a layer its
// row above the values.
TEST_P(EveryLayout, ThePageAndALayersRowHaveTheirRoom) {
    EXPECT_GE(side_.page.size().y, 59 * layout_.scale);
    EXPECT_LE(side_.page.max.y, layout_.timeBar.min.y + 1);
    if (GetParam().layers == 0) return;
    const float row = side_.layers.min.y + kLayersTitle * layout_.scale;
    EXPECT_LE(layerRow(side_.layers, row, layout_.scale).text.max.y, side_.histogramPanel.min.y);
}

TEST(Layout, TheScaleIsWhatIsWantedWhereThereIsRoom) {
    EXPECT_EQ(scaleWithRoom({3840, 2160}, 2), 2);
    EXPECT_EQ(scaleWithRoom({1440, 900}, 2), 2);
    EXPECT_EQ(scaleWithRoom({1440, 900}, 1.25f), 1.25f);
    EXPECT_LT(scaleWithRoom({800, 640}, 2), 1.5f);
    EXPECT_EQ(scaleWithRoom({400, 200}, 2), 1);
    EXPECT_EQ(scaleWithRoom({400, 200}, 0.5f), 0.5f);
}

TEST(Layout, LinesOfTheHelpLieApartWithinThePicture) {
    constexpr std::size_t kLines = 31, kGroups = 6;
    constexpr float kType = 16;  // as makeTheme() has it
    for (const Size& size : {Size{{1440, 900}, 2, 1}, Size{{1440, 900}, 1, 1},
                             Size{{800, 640}, 1, 1}, Size{{3840, 2160}, 2, 1}}) {
        const Rect picture = layoutOf(size.window, size.scale).picture;
        const HelpLayout help = helpLayout(picture, size.scale, kLines, kGroups);
        EXPECT_GE(help.whole.min.y, picture.min.y);
        EXPECT_LE(help.whole.max.y, picture.max.y);
        EXPECT_LE(help.scale, size.scale);
        EXPECT_GE(help.scale, 0.8f * size.scale) << "what does not fit so scrolls";
        EXPECT_LE(help.whole.size().y, help.height + 1);
        EXPECT_LT(kType * help.scale * kLines, help.height);
        const float needed = (kLines * kHelpLine + kGroups * kHelpGroup) * help.scale;
        EXPECT_LE(needed, help.height);
    }
}

TEST_P(EveryLayout, HandlesOfRangesLieBesideBarsNumbersAndEachOther) {
    const float scale = GetParam().scale;
    for (const bool hasMap : {false, true}) {
        const HistogramLayout parts = histogramLayout(side_.histogramPanel, scale, hasMap);
        const Rect& bars = parts.histogram;
        for (float y = bars.min.y - 300; y < bars.max.y + 300; y += 7.3f) {
            const Rect upper = endHandle(parts, scale, y, true),
                       lower = endHandle(parts, scale, y, false);
            for (const Rect& handle : {upper, lower}) {
                EXPECT_LE(handle.max.x, bars.min.x);
                EXPECT_GT(handle.min.x, side_.histogramPanel.min.x);
                EXPECT_GE(handle.min.y, bars.min.y);
                EXPECT_LE(handle.max.y, bars.max.y);
            }
            const bool room = y >= bars.min.y + 12 * scale && y <= bars.max.y - 12 * scale;
            if (room) {
                EXPECT_LE(upper.max.y, lower.min.y + 1) << y;
            }
        }
    }
}

TEST(Layout, ASeriesOfOneStepGivesItsRoomToTheHistogram) {
    const Rect histogramPanel{{1040, 200}, {1440, 500}};
    const HistogramLayout with = histogramLayout(histogramPanel, 1, true),
                          without = histogramLayout(histogramPanel, 1, false);
    EXPECT_EQ(without.map.size().x, 0);
    EXPECT_EQ(without.histogram.size().x, with.histogram.size().x + with.map.size().x);
    EXPECT_EQ(with.histogram.max.x, with.axis.min.x);
    EXPECT_EQ(with.axis.max.x, with.map.min.x);
}

TEST(ValueAxis, ValuesAndPlacesAreEachOthersInverse) {
    const ValueAxis axis{-20, 380, 100, 500};
    EXPECT_EQ(axis.y(-20), 500);
    EXPECT_EQ(axis.y(380), 100);
    for (double value = -20; value <= 380; value += 25)
        EXPECT_NEAR(axis.valueAt(axis.y(value)), value, 1e-4);
    EXPECT_EQ(axis.perPixel(), 1);
}

TEST(StepAxis, EveryStepIsFoundWhereItIsDrawn) {
    const StepAxis axis{31, 100, 720};
    for (std::size_t step = 0; step < axis.steps; ++step)
        EXPECT_EQ(axis.stepAt(axis.centre(step)), step);
    EXPECT_EQ(axis.stepAt(-5), 0u);
    EXPECT_EQ(axis.stepAt(5000), 30u);
}

}  // namespace
}  // namespace app::panels
