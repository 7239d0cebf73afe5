// What is said of the picture below it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/panels/error_parts.h"
#include "app/panels/figures.h"
#include "app/panels/widgets.h"
#include "tests/support/panels_desk.h"
#include "tests/support/random_field.h"
#include "tests/support/scripted_exploration.h"
#include "tests/support/step_bytes.h"

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
    EXPECT_THAT(lines, ElementsAre("1,000 of 4,000 points drawn", "error not known yet",
                                   "4,000 selected  ·  9,000 kept  ·  10,000 in all",
                                   EndsWith("a subset while it moves")));
    r.whole = true;
    r.stride = 1;
    p.frame = 50ms;
    r.drawn = 4000;
    EXPECT_THAT(figuresOf(p, desk.exploration.series()),
                ElementsAre("4,000 points drawn", testing::_, HasSubstr("4,000 selected"),
                            EndsWith("all of it drawn")));
    r.whole = false;
    r.lacksCells = true;
    EXPECT_THAT(figuresOf(p, desk.exploration.series()).back(), EndsWith("points stand for cells"));
}

TEST(Figures, SayWhetherTheStepIsFromTheIndex) {
    const auto grid = tests::gridOf(std::array<std::size_t, 3>{2, 2, 2});
    const timeseries::Field field{
        .grid = grid, .values = std::vector<float>(8, 1), .missing = {}, .categories = false};
    const auto built =
        std::make_shared<const timeseries::SortedStep>(timeseries::SortedStep::build(field));
    const auto stored = std::make_shared<const timeseries::SortedStep>(
        timeseries::SortedStep::ofFile(tests::opened(tests::written(*built)), grid, false));
    timeseries::Series series(2, 1 << 20);
    (void)series.want(std::vector<std::size_t>{0, 1});
    (void)series.loaded(0, built);
    (void)series.loaded(1, stored);
    Performance p{.frame = 5ms, .budget = 33ms};
    p.report.counts = PointCounts{.layers = {8}, .selected = 8, .kept = 8, .total = 8};
    for (const std::size_t step : {0u, 1u}) {
        p.report.step = step;
        EXPECT_EQ(figuresOf(p, &series).back().find("from the index") != std::string::npos,
                  step == 1)
            << step;
    }
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
                ElementsAre("3,321 cells drawn", testing::_, HasSubstr("71 selected"), testing::_));
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
    for (const auto& [error, text] : {std::pair(0.0004, "error below 0.1 %"),
                                      {0.0041, "error about 0.4 %"},
                                      {0.123, "error about 12 %"}}) {
        p.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = error}}};
        EXPECT_THAT(figuresOf(p, desk.exploration.series()),
                    ElementsAre("7 points drawn", text, HasSubstr("7 selected"), testing::_));
    }
}

TEST(Figures, SayWhereNobodyKnowsTheError) {
    tests::ScriptedExploration desk;
    Performance p = sevenPoints();
    EXPECT_EQ(figuresOf(p, desk.exploration.series())[1], "error not known yet");
    EXPECT_EQ(errorPartLines(p)[0].what, "This picture's error is not known yet.");
    p.errors.emplace().whyNone = "nothing lies between categories";
    EXPECT_EQ(figuresOf(p, desk.exploration.series())[1], "error not known");
    EXPECT_EQ(errorPartLines(p)[0].what,
              "This picture's error is not known: nothing lies between categories.");
}

// As of points that have a field's greatest value, between which there is nothing.
TEST(Figures, SayThatNothingIsSeen) {
    tests::ScriptedExploration desk;
    Performance p = sevenPoints();
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    p.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = kNan}}};
    EXPECT_EQ(figuresOf(p, desk.exploration.series())[1],
              "nothing is seen of what lies in the ranges");
    EXPECT_EQ(errorPartLines(p)[0].what,
              "nothing is seen of what lies in the ranges: there is no error");
    p.isErrorOfAnother = true;
    EXPECT_THAT(figuresOf(p, desk.exploration.series()),
                ElementsAre("7 points drawn", HasSubstr("7 selected"), testing::_));
}

// Until this picture's own is known.
TEST(Figures, SayOfAnotherPicturesErrorThatItWas) {
    tests::ScriptedExploration desk;
    Performance p = sevenPoints();
    p.isErrorOfAnother = true;
    for (const auto& [error, text] :
         {std::pair(0.0004, "error was below 0.1 %"), {0.0041, "error was about 0.4 %"}}) {
        p.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = error}}};
        EXPECT_EQ(figuresOf(p, desk.exploration.series())[1], text);
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
    EXPECT_THAT(figuresOf(p, desk.exploration.series())[1], HasSubstr("error was above 18 %"));
    EXPECT_THAT(errorLines(p).back(),
                testing::AllOf(HasSubstr("above 18 %  1 of 64 points"), HasSubstr("as drawn")));
    EXPECT_EQ(errorPartLines(p)[1].what, "known once the picture rests");
}

// Where colours are mixed, the same figure says what that costs.
TEST(Figures, StateTheErrorOfLightWhereColoursAreMixed) {
    tests::ScriptedExploration desk;
    Performance p = sevenPoints();
    p.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = 0.03, .order = 0.08}},
                           .ordering = Ordering::Mixed};
    EXPECT_EQ(figuresOf(p, desk.exploration.series())[1],
              "error about 3 %, light 8 % (colours mixed)");
}

std::vector<std::string> figuresIn(std::string_view line) {
    constexpr std::string_view kApart = "  ·  ";
    std::vector<std::string> figures;
    for (std::size_t end = 0; end != std::string_view::npos;
         line.remove_prefix(end + kApart.size())) {
        end = line.find(kApart);
        figures.emplace_back(line.substr(0, end));
        if (end == std::string_view::npos) break;
    }
    return figures;
}

// Beside it figures are left out, none is cut, and where it stands it is pressed.
TEST(Figures, KeepTheErrorWholeInEveryWindow) {
    tests::PanelsDesk desk;
    Performance p = sevenPoints();
    p.report.cells = 19'684;
    p.report.besideCells = 512;
    p.report.counts->inClipBox = true;
    p.errors = DepthErrors{.rungs = {{.rung = {Model::Cells}, .depth = 0.03, .order = 0.006}},
                           .ordering = Ordering::ByDepth};
    const std::string error = "error about 3 %, light 0.6 % (colours within a cell)";
    ImFont& font = *desk.theme().small;
    std::vector<std::string> all;
    for (const std::string& line : figuresOf(p, desk.exploration.series()))
        for (const std::string& figure : figuresIn(line)) all.push_back(figure);
    for (float width = 640; width < 2000; width += 10) {
        SCOPED_TRACE(width);
        const Layout layout = layoutOf({width, 600}, 1);
        const ShownFigures shown = shownFigures(desk.theme(), layout, p, desk.exploration.series());
        EXPECT_LE(shown.lines.size(), statusLines(layout));
        const float room = layout.status.size().x - 2 * kMargin;
        for (const std::string& line : shown.lines) EXPECT_LE(widthOf(font, line), room) << line;
        const auto has = [&](const std::string& line) { return line.find(error) != line.npos; };
        const auto line = std::ranges::find_if(shown.lines, has);
        ASSERT_NE(line, shown.lines.end());
        EXPECT_THAT(figuresIn(*line), testing::IsSubsetOf(all));
        const float left =
            layout.status.min.x + kMargin + widthOf(font, line->substr(0, line->find(error)));
        ASSERT_TRUE(shown.error);
        EXPECT_NEAR(shown.error->min.x, left, 5);
        EXPECT_NEAR(shown.error->max.x, left + widthOf(font, error), 5);
        const auto lines = static_cast<float>(line - shown.lines.begin());
        EXPECT_NEAR(shown.error->centre().y, layout.status.min.y + 13 + 18 * lines, 1);
    }
}

// Where it has no room, the reason goes: the numbers stay.
TEST(Figures, KeepTheErrorsNumbersInAWindowOfNoWidth) {
    tests::PanelsDesk desk;
    Performance p = sevenPoints();
    p.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = 0.03, .order = 0.08}},
                           .ordering = Ordering::Mixed};
    const Layout layout = layoutOf({520, 600}, 1);
    const auto shown = shownFigures(desk.theme(), layout, p, desk.exploration.series());
    EXPECT_THAT(shown.lines, testing::Contains("error about 3 %, light 8 %"));
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
