#include "app/measure/trade_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <regex>
#include <stdexcept>

#include "app/measure/plot_svg.h"
#include "app/measure/plot_text.h"
#include "tests/support/measured_modes.h"

namespace app {
namespace {

using tests::measuredAt;

using testing::HasSubstr;
using testing::Not;

std::string svgOfModes(std::span<const Measured> modes, const std::string& title) {
    return plotSvg(tradePlot(modes, title));
}

struct Mark {
    double x, y;
    std::string fill;
};
std::vector<Mark> marksOf(const std::string& svg) {
    static const std::regex circle(R"re(<circle cx="([^"]+)" cy="([^"]+)" r="5" fill="([^"]+)")re");
    std::vector<Mark> marks;
    for (std::sregex_iterator i(svg.begin(), svg.end(), circle), end; i != end; ++i)
        marks.push_back({std::stod((*i)[1]), std::stod((*i)[2]), (*i)[3]});
    return marks;
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t times = 0;
    for (auto i = text.find(what); i != std::string::npos; i = text.find(what, i + 1)) ++times;
    return times;
}

// Ten times the time is as far to the right wherever it is, and ten times the error as far up.
TEST(TradePlot, IsLogarithmicInBoth) {
    const std::vector modes = {measuredAt(0.001, 0.1), measuredAt(0.01, 0.01),
                               measuredAt(0.1, 0.001)};
    const auto marks = marksOf(svgOfModes(modes, ""));
    ASSERT_EQ(marks.size(), 3u);
    EXPECT_NEAR(marks[1].x - marks[0].x, marks[2].x - marks[1].x, 0.11);
    EXPECT_NEAR(marks[1].y - marks[0].y, marks[2].y - marks[1].y, 0.11);
    EXPECT_GT(marks[1].x, marks[0].x + 100);
    EXPECT_GT(marks[1].y, marks[0].y + 100);  // a smaller error stands lower
}

TEST(TradePlot, EscapesText) {
    const std::string svg = svgOfModes(std::vector{measuredAt(1, 1)}, "a<b> & \"c\"\x01 \xb0");
    EXPECT_THAT(svg, HasSubstr("a&lt;b&gt; &amp; &quot;c&quot;  \ufffd<"));  // a Latin-1 degree
    EXPECT_EQ(count(svg, "<svg"), count(svg, "</svg>"));
    EXPECT_EQ(count(svg, "<text"), count(svg, "</text>"));
    EXPECT_EQ(count(svg, "<g>"), count(svg, "</g>"));
}

TEST(TradePlot, AModeWhoseMassIsOffIsHollow) {
    const std::string svg = svgOfModes(
        std::vector{measuredAt(0.01, 0.1, {}, 1.2), measuredAt(0.1, 0.01, {{Model::Cells}})}, "");
    const auto marks = marksOf(svg);
    EXPECT_EQ(marks[0].fill, "#ffffff");
    EXPECT_NE(marks[1].fill, "#ffffff");
    EXPECT_THAT(svg, HasSubstr("points (mass +20 %)"));
    EXPECT_THAT(svg, HasSubstr("hollow: its mass is more than 5 % off"));
    EXPECT_THAT(svgOfModes(std::vector{measuredAt(0.01, 0.1)}, ""), Not(HasSubstr("hollow")));
}

// No error, or none that is a number, stands at the end of its axis.
TEST(TradePlot, WhatHasNoLogarithmStaysInThePicture) {
    for (const double error : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        const std::string svg =
            svgOfModes(std::vector{measuredAt(0.01, error), measuredAt(0.1, 0.3)}, "");
        for (const Mark& mark : marksOf(svg)) {
            EXPECT_GE(mark.x, 0);
            EXPECT_LE(mark.x, 720);
            EXPECT_GE(mark.y, 0) << error;
            EXPECT_LE(mark.y, 480) << error;
        }
        EXPECT_THAT(svg, Not(HasSubstr("\"nan\"")));
        EXPECT_THAT(svg, Not(HasSubstr("\"inf\"")));
    }
    EXPECT_EQ(marksOf(svgOfModes(std::vector{measuredAt(0, 0)}, "")).size(), 1u);
}

TEST(TradePlot, JoinsTheSubsetsOfOneOrder) {
    const std::vector modes = {measuredAt(0.01, 0.3, {{Model::Points, 2}}),
                               measuredAt(0.02, 0.2, {{Model::Points}}),
                               measuredAt(0.02, 0.2, {{Model::Points}, render::Order::BackToFront}),
                               measuredAt(0.1, 0.01, {{Model::Cells}})};
    EXPECT_EQ(count(svgOfModes(modes, ""), "stroke-width=\"1.5\""), 1u);
}

const PlotText& textOf(const Plot& plot, const std::string& begin) {
    for (const PlotShape& shape : plot.shapes)
        if (const auto* text = std::get_if<PlotText>(&shape))
            if (text->text.starts_with(begin)) return *text;
    throw std::runtime_error("no such text: " + begin);
}

// A name each would hide what they tell.
TEST(TradePlot, SubsetsOfOneOrderAloneAreNamed) {
    std::vector<Measured> modes;
    for (const Mode& mode : modesFor({.severalColors = true}))
        modes.push_back(measuredAt(0.01, 0.1, mode));
    const std::string svg = svgOfModes(modes, "");
    for (const char* share : {"1/2", "1/4", "1/8"})
        EXPECT_EQ(count(svg, std::string(">") + share + "<"), 1u) << share;
    for (const char* name : {"points, by depth", "points, mixed", "coarse points", "coarse cells"})
        EXPECT_EQ(count(svg, std::string(">") + name + "<"), 1u) << name;
}

// There is no room to the right of a mark at the right end, 696.
TEST(TradePlot, ANameLeftOfItsMarkEndsTwoRadiiBesideIt) {
    const Plot plot = tradePlot(
        std::vector{measuredAt(0.001, 0.1), measuredAt(0.1, 0.03, {{Model::Cells}}, 1.2)}, "");
    const PlotText& name = textOf(plot, "cells (mass +20 %)");
    const PlotFont font(std::array{name.lettering});
    EXPECT_NEAR(name.at.x + font.width(name.text, name.lettering), 696 - 2 * 5, 1e-6);
}

// The line to the other mark leaves to the right, where a name would stand first.
TEST(TradePlot, ANameStandsOnNoLine) {
    for (const double error : {0.03, 0.02}) {
        const Plot plot = tradePlot(
            std::vector{measuredAt(0.001, 0.03, {{Model::Points, 2}}), measuredAt(0.1, error)}, "");
        const PlotText& name = textOf(plot, "1/2");
        const auto joining = std::ranges::find_if(plot.shapes, [](const PlotShape& shape) {
            const auto* line = std::get_if<PlotLine>(&shape);
            return line != nullptr && line->dash > 0;
        });
        ASSERT_NE(joining, plot.shapes.end());
        const auto& line = std::get<PlotLine>(*joining);
        const double share = (name.at.x - line.from.x) / (line.to.x - line.from.x);
        const double there = std::lerp(line.from.y, line.to.y, share);
        EXPECT_TRUE(there > name.at.y + 1 || there < name.at.y - 9)
            << "a line at " << there << " through letters that stand on " << name.at.y;
    }
}

TEST(TradePlot, ATitleEndsWithinThePlot) {
    const std::vector modes = {measuredAt(0.01, 0.1)};
    for (const bool isLong : {false, true}) {
        const std::string title = "fire.nc: T, " + std::string(isLong ? 200 : 20, 'm');
        const PlotText shown = textOf(tradePlot(modes, title), "fire.nc: T, mmm");
        const PlotFont font(std::array{shown.lettering});
        EXPECT_LE(font.width(shown.text, shown.lettering), 696 - 84);
        if (isLong)
            EXPECT_GT(font.width(shown.text + "mm", shown.lettering), 696 - 84) << "cut too soon";
        else
            EXPECT_EQ(shown.text, title);
    }
}

}  // namespace
}  // namespace app
