// What a plot's pixels are follows from its shapes, twice as large.
#include "app/measure/plot_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/measure/plot_text.h"
#include "app/measure/trade_plot.h"
#include "render/annotate/flat_mesh.h"
#include "render/image/color.h"
#include "tests/support/measured_modes.h"

namespace app {
namespace {

using tests::measuredAt;

using render::Image;

// As a PNG has it.
PlotColor pixelAt(const Image& picture, int x, int y) {
    PlotColor color = 0;
    for (int k = 0; k < 3; ++k) color = color << 8 | render::srgb8FromLinear(picture.at(x, y)[k]);
    return color;
}

Image drawnPlot(glm::ivec2 size, std::vector<PlotShape> shapes) {
    return plotPicture({size, std::move(shapes)});
}

// How much ink there is, as the light that is missing from paper, summed over pixels [lo, hi).
double inkIn(const Image& picture, glm::ivec2 lo, glm::ivec2 hi) {
    double ink = 0;
    for (int y = lo.y; y < hi.y; ++y)
        for (int x = lo.x; x < hi.x; ++x) ink += 1 - static_cast<double>(picture.at(x, y).g);
    return ink;
}
double inkIn(const Image& picture) { return inkIn(picture, {0, 0}, picture.size); }

// The least rectangle with all that is darker than half of paper.
render::PixelRect darkIn(const Image& picture) {
    render::PixelRect dark{glm::dvec2(picture.size), glm::dvec2(0)};
    for (int y = 0; y < picture.size.y; ++y)
        for (int x = 0; x < picture.size.x; ++x)
            if (picture.at(x, y).g < 0.5f) dark = render::around(dark, {{x, y}, {x + 1, y + 1}});
    return dark;
}

TEST(PlotPicture, IsTwiceThePlotAndOpaquePaper) {
    const Image picture = drawnPlot({30, 20}, {});
    EXPECT_EQ(picture, Image({60, 40}, glm::vec4(1)));
}

// The first row is the top one: a line of width 1 at 5 covers 4.5 to 5.5, rows 9 and 10.
TEST(PlotPicture, AGridLineIsItsPixels) {
    const Image picture = drawnPlot({30, 20}, {PlotLine{{4, 5}, {20, 5}, 0xd0d7de}});
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x) {
            const bool on = x >= 8 && x < 40 && (y == 9 || y == 10);
            EXPECT_EQ(pixelAt(picture, x, y), on ? 0xd0d7de : kPaper) << x << ' ' << y;
        }
}

TEST(PlotPicture, DashesAndGapsFollowEachOther) {
    PlotLine line{{2, 10}, {26, 10}, 0x000000, 2};
    line.dash = 4;
    line.gap = 3;
    const Image picture = drawnPlot({30, 20}, {line});
    for (int x = 0; x < 60; ++x) {
        const double along = (x + 0.5) / 2 - 2;
        const bool on = along > 0 && along < 24 && std::fmod(along, 7) < 4;
        EXPECT_EQ(pixelAt(picture, x, 20), on ? 0x000000u : kPaper) << x;
    }
}

// Later shapes lie over earlier ones.
TEST(PlotPicture, AFilledMarkCoversWhatLiesUnderIt) {
    const Image picture = drawnPlot(
        {30, 20},
        {PlotLine{{0, 10}, {30, 10}, 0x000000, 2},
         PlotCircle{
             .middle = {15, 10}, .radius = 5, .fill = 0x0969da, .rim = 0x0969da, .rimWidth = 2}});
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x) {
            const double off = std::hypot(x + 0.5 - 30, y + 0.5 - 20);
            if (off < 11.4) {
                EXPECT_EQ(pixelAt(picture, x, y), 0x0969dau) << x << ' ' << y;
            }
            if (off > 12.6 && std::abs(y + 0.5 - 20) > 2.6) {
                EXPECT_EQ(pixelAt(picture, x, y), kPaper) << x << ' ' << y;
            }
        }
}

TEST(PlotPicture, AHollowMarkIsItsRimAroundPaper) {
    const Image picture = drawnPlot(
        {30, 20},
        {PlotLine{{0, 10}, {30, 10}, 0x000000, 2},
         PlotCircle{
             .middle = {15, 10}, .radius = 5, .fill = kPaper, .rim = 0xc2410c, .rimWidth = 2}});
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x) {
            const double off = std::hypot(x + 0.5 - 30, y + 0.5 - 20);
            if (off < 7.4) {
                EXPECT_EQ(pixelAt(picture, x, y), kPaper) << x << ' ' << y;
            }
            if (off > 8.6 && off < 11.4) {
                EXPECT_EQ(pixelAt(picture, x, y), 0xc2410cu) << x << ' ' << y;
            }
        }
}

// Steps between ink and paper are many: the light missing is the disc's area.
TEST(PlotPicture, AMarksEdgeIsSoft) {
    const Image picture =
        drawnPlot({30, 20}, {PlotCircle{.middle = {15.1, 10.2}, .radius = 5, .rimWidth = 2}});
    EXPECT_NEAR(inkIn(picture), std::numbers::pi * 12 * 12, 0.01 * std::numbers::pi * 12 * 12);
    const auto between = std::ranges::count_if(
        picture.pixels, [](const glm::vec4& pixel) { return pixel.g > 0.02f && pixel.g < 0.98f; });
    EXPECT_GT(between, 12 * 4);
}

// Inter's capitals are 2048 of the em's 2816 units tall and stand on the baseline.
TEST(PlotPicture, CapitalsStandOnTheBaselineAsTallAsTheEmSays) {
    for (const double size : {12.0, 16.0}) {
        const auto dark = darkIn(
            drawnPlot({60, 40}, {PlotText{{20, 30}, Anchor::Start, {size}, 0x000000, "HH"}}));
        EXPECT_NEAR(dark.hi.y, 60, 0.5) << size;
        EXPECT_NEAR(dark.hi.y - dark.lo.y, 2 * size * 2048 / 2816, 1.1) << size;
        EXPECT_NEAR(dark.lo.x, 40, 3) << size;
    }
}

TEST(PlotPicture, AnchorsAreWhereATextBeginsHasItsMiddleOrEnds) {
    const auto darkAt = [](Anchor anchor) {
        return darkIn(drawnPlot({120, 40}, {PlotText{{60, 30}, anchor, {12}, 0x000000, "HNNH"}}));
    };
    const auto start = darkAt(Anchor::Start), middle = darkAt(Anchor::Middle),
               end = darkAt(Anchor::End);
    const double bearing = 3;  // beside an H, on both sides alike
    EXPECT_NEAR(start.lo.x, 120, bearing);
    EXPECT_NEAR(end.hi.x, 120, bearing);
    EXPECT_NEAR((middle.lo.x + middle.hi.x) / 2, 120, 1);
    EXPECT_GT(start.hi.x - start.lo.x, 60) << "or nothing was anchored";
}

TEST(PlotPicture, SemiBoldIsDarker) {
    const auto ink = [](render::FontWeight weight) {
        return inkIn(drawnPlot(
            {60, 40}, {PlotText{{10, 30}, Anchor::Start, {16, weight}, 0x000000, "Hill"}}));
    };
    EXPECT_GT(ink(render::FontWeight::SemiBold), 1.15 * ink(render::FontWeight::Regular));
}

// A name of a file may hold anything.
TEST(PlotPicture, ControlCharactersAreSpaces) {
    const auto of = [](std::string text) {
        return drawnPlot({120, 40},
                         {PlotText{{10, 20}, Anchor::Start, {12}, 0x000000, std::move(text)}});
    };
    EXPECT_EQ(of("a\nb\x01"
                 "c"),
              of("a b c"));
    EXPECT_GT(inkIn(of("a b c")), 50);
}

// Of a plot from 1 to 100 ms and from 1 to 100 %, in pixels; its frame is 84 to 696 and 84 to 412.
glm::dvec2 placeOf(double frame, double error) {
    return {2 * (84 + (696 - 84) * (std::log10(frame) + 3) / 2),
            2 * (412 - (412 - 84) * (std::log10(error) + 2) / 2)};
}

class TradePicture : public testing::Test {
 protected:
    const std::vector<Measured> modes{measuredAt(0.001, 0.8, {{Model::Points, 4}}),
                                      measuredAt(0.004, 0.3, {}, 1.2),
                                      measuredAt(0.09, 0.012, {{Model::Cells}})};
    const Image picture = plotPicture(tradePlot(modes, "fire.nc: T, 1 to 2 K"));
    PlotColor atMark(const Measured& m, double right) const {
        const glm::dvec2 place = placeOf(m.frame, m.depthError);
        return pixelAt(picture, static_cast<int>(place.x + right), static_cast<int>(place.y));
    }
};

TEST_F(TradePicture, MarksAreWhereTheScalesSay) {
    EXPECT_EQ(picture.size, glm::ivec2(1440, 960));
    for (const double right : {-10.0, 0.0, 10.0}) {
        EXPECT_EQ(atMark(modes[0], right), 0x0969dau) << right;
        EXPECT_EQ(atMark(modes[2], right), 0xc2410cu) << right;
    }
    EXPECT_EQ(atMark(modes[1], 0), kPaper) << "its mass is off";
    EXPECT_EQ(atMark(modes[1], 10), 0x0969dau);
    EXPECT_EQ(atMark(modes[1], -10), 0x0969dau);
    EXPECT_EQ(atMark(modes[2], 20), kPaper) << "beside it, or all is of its colour";
}

TEST_F(TradePicture, GridLinesAreWhereTheScalesSay) {
    const int fiveMs = static_cast<int>(placeOf(0.005, 1).x), below = 2 * 412 - 30;
    const auto columnHas = [&](int middle, PlotColor color) {
        for (int x = middle - 1; x <= middle + 1; ++x)
            if (pixelAt(picture, x, below) == color) return true;
        return false;
    };
    EXPECT_TRUE(columnHas(fiveMs, 0xf0f2f4));
    EXPECT_TRUE(columnHas(static_cast<int>(placeOf(0.01, 1).x), 0xd0d7de));
    EXPECT_FALSE(columnHas(static_cast<int>(placeOf(0.0055, 1).x), 0xf0f2f4)) << "between two";
    const int tenPercent = static_cast<int>(placeOf(0.01, 0.1).y);
    EXPECT_EQ(pixelAt(picture, 1300, tenPercent), 0xd0d7deu);
    EXPECT_EQ(pixelAt(picture, 1410, tenPercent), kPaper) << "right of the frame";
}

TEST_F(TradePicture, TextsStandWhereTheyBelong) {
    const struct {
        const char* what;
        glm::ivec2 lo, hi;
        bool isThere;
    } places[] = {{"the title", {168, 36}, {500, 76}, true},
                  {"the name of the axis of errors", {168, 120}, {500, 150}, true},
                  {"10 ms, under the middle", {740, 840}, {820, 866}, true},
                  {"between 1 and 10 ms", {400, 836}, {600, 880}, false},
                  {"the name of the axis of time", {700, 890}, {860, 922}, true},
                  {"10 %, left of the axis", {90, 480}, {152, 512}, true},
                  {"between 1 and 10 %", {0, 600}, {152, 720}, false},
                  {"what hollow means", {1000, 920}, {1392, 944}, true},
                  {"left of it", {0, 925}, {900, 960}, false}};
    for (const auto& place : places) {
        const double ink = inkIn(picture, place.lo, place.hi);
        if (place.isThere)
            EXPECT_GT(ink, 100) << place.what;
        else
            EXPECT_EQ(ink, 0) << place.what;
    }
}

TEST(PlotText, WidthIsHalfOfWhatAPictureHas) {
    constexpr Lettering kOne{12}, kOther{16, render::FontWeight::SemiBold};
    const PlotFont font(std::array{kOne, kOther});
    for (const Lettering& lettering : {kOne, kOther}) {
        const auto dark = darkIn(drawnPlot(
            {200, 40}, {PlotText{{4, 30}, Anchor::Start, lettering, 0x000000, "HIlliWHmmmH"}}));
        EXPECT_NEAR(font.width("HIlliWHmmmH", lettering), (dark.hi.x - dark.lo.x) / 2, 3);
        EXPECT_GT(font.width("mmm", lettering), 2 * font.width("iii", lettering));
    }
}

}  // namespace
}  // namespace app
