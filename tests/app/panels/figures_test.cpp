// What is said of the picture over its lower right corner.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/panels/error_parts.h"
#include "app/panels/figures.h"
#include "tests/support/scripted_exploration.h"

namespace app::panels {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

// Of the picture, whatever the exploration has come to since.
TEST(Figures, AreOfThePictureAlone) {
    tests::ScriptedExploration desk;
    Performance p{.frame = 5ms, .budget = 33ms};
    CanvasReport& r = p.report;
    r.drawn = 1000;
    r.selected = 4000;
    r.stride = 4;
    r.counts = PointCounts{.layers = {4000}, .selected = 4000, .kept = 9000, .total = 10000};
    r.whole = false;
    const auto lines = figuresOf(p, desk.exploration.series());
    EXPECT_THAT(lines, ElementsAre("1,000 of 4,000 points drawn",
                                   "4,000 selected  ·  9,000 kept  ·  10,000 in all",
                                   EndsWith("a subset while it moves")));
    r.whole = true;
    r.stride = 1;
    p.frame = 50ms;
    r.drawn = 4000;
    EXPECT_THAT(figuresOf(p, desk.exploration.series()),
                ElementsAre("4,000 points drawn", HasSubstr("4,000 selected"),
                            EndsWith("all of it drawn")));
    r.whole = false;
    r.lacksCells = true;
    EXPECT_THAT(figuresOf(p, desk.exploration.series()).back(), EndsWith("points stand for cells"));
}

TEST(Figures, CountCellsWhereTheyAreDrawn) {
    tests::ScriptedExploration desk;
    Performance p{.frame = 5ms, .budget = 33ms};
    CanvasReport& r = p.report;
    r.whole = true;
    r.drawn = r.selected = 71;
    r.cells = 3321;
    r.counts = PointCounts{.layers = {71}, .selected = 71, .kept = 100, .total = 100};
    EXPECT_THAT(figuresOf(p, desk.exploration.series()),
                ElementsAre("3,321 cells drawn", HasSubstr("71 selected"), testing::_));
    r.counts->inClipBox = true;
    EXPECT_EQ(figuresOf(p, desk.exploration.series()).front(),
              "3,321 cells drawn, before clipping");
}

Performance sevenPoints() {
    Performance p{.frame = 5ms, .budget = 33ms};
    p.report.whole = true;
    p.report.drawn = p.report.selected = 7;
    p.report.counts = PointCounts{.layers = {7}, .selected = 7, .kept = 10, .total = 10};
    return p;
}

TEST(Figures, StateTheErrorOnceItIsKnown) {
    tests::ScriptedExploration desk;
    Performance p = sevenPoints();
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [error, text] : {std::pair(0.0004, "7 points drawn  ·  error below 0.1 %"),
                                      {0.0041, "7 points drawn  ·  error about 0.4 %"},
                                      {0.123, "7 points drawn  ·  error about 12 %"},
                                      {kNan, "7 points drawn"}}) {
        p.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = error}}};
        EXPECT_EQ(figuresOf(p, desk.exploration.series()).front(), text);
    }
}

// Until this picture's own is known.
TEST(Figures, SayOfAnotherPicturesErrorThatItWas) {
    tests::ScriptedExploration desk;
    Performance p = sevenPoints();
    p.isErrorOfAnother = true;
    for (const auto& [error, text] : {std::pair(0.0004, "7 points drawn  ·  error was below 0.1 %"),
                                      {0.0041, "7 points drawn  ·  error was about 0.4 %"}}) {
        p.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = error}}};
        EXPECT_EQ(figuresOf(p, desk.exploration.series()).front(), text);
    }
}

// Of fewer points than any whose error is known.
TEST(Figures, SayThatTheErrorOfStillFewerPointsIsMore) {
    tests::ScriptedExploration desk;
    Performance p = sevenPoints();
    p.report.stride = 64;
    p.report.whole = false;
    p.isErrorOfAnother = true;
    p.errors = DepthErrors{.rungs = {{.rung = {Model::Points, 16}, .depth = 0.18}}};
    EXPECT_THAT(figuresOf(p, desk.exploration.series()).front(), HasSubstr("error was above 18 %"));
    EXPECT_THAT(errorLines(p).back(),
                testing::AllOf(HasSubstr("above 18 %  1 of 64 points"), HasSubstr("as drawn")));
    EXPECT_EQ(errorPartLines(p)[1].what, "known once the picture rests");
}

// Where colours are mixed, the same line says what that costs.
TEST(Figures, StateTheErrorOfLightWhereColoursAreMixed) {
    tests::ScriptedExploration desk;
    Performance p = sevenPoints();
    p.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = 0.03, .order = 0.08}},
                           .ordering = Ordering::Mixed};
    EXPECT_EQ(figuresOf(p, desk.exploration.series()).front(),
              "7 points drawn  ·  error about 3 %, light 8 % (colours mixed)");
}

TEST(Figures, PartsOfTheErrorAreTheWholeThenEachOnceItIsKnown) {
    Performance p{.frame = 5ms, .budget = 33ms};
    const auto names = [&] {
        std::vector<std::string> all;
        for (const ErrorLine& line : errorPartLines(p)) all.push_back(line.name + " " + line.size);
        return all;
    };
    EXPECT_EQ(errorPartLines(p).front().what, "This picture's error is not known yet.");
    p.errors.emplace().whyNone = "there is not enough memory to work it out";
    EXPECT_EQ(errorPartLines(p).front().what,
              "This picture's error is not known: there is not enough memory to work it out.");
    EXPECT_THAT(errorLines(p), ElementsAre(HasSubstr("not enough memory")));
    p.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = 0.03, .order = 0.08}},
                           .ordering = Ordering::Mixed};
    EXPECT_THAT(names(), ElementsAre("whole 3 %", "model …", "subset …", "pixels …", "order …"));
    p.errors->rungs[0].parts = ErrorParts{.model = 0.02, .subset = 0, .pixels = 0.01};
    EXPECT_THAT(names(),
                ElementsAre("whole 3 %", "model 2 %", "subset none", "pixels 1 %", "order 8 %"));
}

TEST(Figures, TellWhatOtherWaysToDrawWouldHave) {
    Performance p{.frame = 5ms, .budget = 33ms};
    EXPECT_TRUE(errorLines(p).empty());
    p.report.stride = 8;
    p.errors = DepthErrors{.rungs = {{.rung = {Model::Cells}, .depth = 0.004},
                                     {.rung = {Model::Points, 8}, .depth = 0.31}}};
    EXPECT_THAT(errorLines(p), ElementsAre(HasSubstr("against the field between its points"),
                                           "0.4 %  cells", "31 %  1 of 8 points, as drawn"));
    p.report.cells = 10;
    p.report.stride = 1;
    EXPECT_THAT(errorLines(p),
                ElementsAre(testing::_, "0.4 %  cells, as drawn", "31 %  1 of 8 points"));
}

TEST(Figures, AreNoneBeforeThereIsAPicture) {
    tests::ScriptedExploration desk;
    EXPECT_TRUE(figuresOf({}, desk.exploration.series()).empty());
    EXPECT_TRUE(figuresOf({.report = {.counts = PointCounts{}}}, nullptr).empty());
}

}  // namespace
}  // namespace app::panels
