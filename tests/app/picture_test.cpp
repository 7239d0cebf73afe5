#include "app/picture/picture.h"
#include "app/picture/resolved.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "app/choices/choice_text.h"
#include "app/choices/sweep_edits.h"
#include "tests/support/picture_of_a_ramp.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"

namespace app {
namespace {

using testing::HasSubstr;
using timeseries::RangeSet;
using timeseries::SortedStep;
using namespace app::ramp;

// Counts are of points, whatever is drawn.
TEST_F(PictureOfARamp, CellsReachIntoTheRangesBetweenPoints) {
    Explorer e = withRanges({"500.25:500.75"});
    e.layers[0].opacity = 0.5;
    EXPECT_EQ(pictureOf(e).scene.cells, nullptr);
    e.model = Model::Cells;
    const Picture picture = pictureOf(e);
    ASSERT_NE(picture.scene.cells, nullptr);
    EXPECT_TRUE(picture.scene.layers[0].runs.empty());
    EXPECT_FALSE(picture.scene.layers[0].cells.candidates.empty());
    EXPECT_THAT(picture.legend.layers[0].amount, HasSubstr("0 points"));
    EXPECT_THAT(picture.legend.notes, testing::Contains("interpolated between points"));
}

// Older sessions say of all layers at once what they are drawn by.
TEST_F(PictureOfARamp, EachLayerMayHaveAModelOfItsOwn) {
    Explorer e = withRanges({"100:199", "500:600", "700:800"});
    e.model = Model::Cells;
    e.layers[1].model = Model::Points;
    const Picture picture = pictureOf(e);
    const auto& layers = picture.scene.layers;
    ASSERT_NE(picture.scene.cells, nullptr);
    EXPECT_TRUE(mixesModels(picture.scene));
    for (const std::size_t k : {0, 1, 2}) {
        EXPECT_EQ(layers[k].byPoints, k == 1);
        EXPECT_EQ(layers[k].cells.candidates.empty(), k == 1);
        EXPECT_FALSE(layers[k].cells.ranges.empty());
        EXPECT_EQ(drawnCount(picture.scene, layers[k]),
                  k == 1 ? pointCount(layers[k]) : cellCount(layers[k]));
    }
    EXPECT_THAT(picture.legend.notes,
                testing::ElementsAre("interpolated between points", "layer 2 by points alone"));
    // What is not seen takes no part.
    e.layers[1].visible = false;
    EXPECT_FALSE(mixesModels(pictureOf(e).scene));
    EXPECT_EQ(pictureOf(e).legend.notes.size(), 1u);
    // One by cells among points.
    e = allBy(Model::Points, e);
    e.layers[1].visible = true;
    EXPECT_EQ(pictureOf(e).scene.cells, nullptr);
    e.layers[0].model = Model::Cells;
    EXPECT_THAT(pictureOf(e).legend.notes, testing::Contains("layers 2 and 3 by points alone"));
    e.layers[1].visible = false;
    EXPECT_THAT(pictureOf(e).legend.notes, testing::Contains("layer 3 by points alone"));
}

TEST_F(PictureOfARamp, OnlyLayersByCellsNeedCells) {
    Explorer e = withRanges({"100:199", "500:600"});
    e.layers[0].model = Model::Cells;
    const auto needed = cellsNeeded(e, step_->type());
    ASSERT_EQ(needed.size(), 1u);
    EXPECT_EQ(needed[0].lo, timeseries::betweenPoints(e.layers[0].ranges, step_->type())[0].lo);
    EXPECT_EQ(modelOf(e), Model::Cells);
    e.layers[0].visible = false;
    EXPECT_EQ(modelOf(e), Model::Points);
    EXPECT_TRUE(cellsNeeded(e, step_->type()).empty());
}

TEST_F(PictureOfARamp, WithoutAllValuesPointsAreDrawnAndTheLegendSaysSo) {
    step_ = ramp(0, RangeSet::parse("100:900"));
    steps_ = {{1, step_}};
    Explorer e = withRanges({"200:300"});
    e.model = Model::Cells;
    const Picture picture = pictureOf(e);
    EXPECT_EQ(picture.scene.cells, nullptr);
    EXPECT_THAT(picture.legend.notes,
                testing::Contains("drawn by points: cells need every value kept"));
}

TEST_F(PictureOfARamp, TheLegendStatesTitleTimeLayersAndCounts) {
    const Picture p = pictureOf(withRanges({"100:199", "990:max", "2000:3000", "0,5,9", "7"}));
    EXPECT_EQ(p.legend.title, "temperature (K)");
    EXPECT_EQ(p.legend.time, "0.5 s, step 1 of 0–2");
    ASSERT_EQ(p.legend.layers.size(), 5u);
    EXPECT_EQ(p.legend.layers[0].range, "100 to 199 K");
    EXPECT_EQ(p.legend.layers[0].amount, "100 points, 10 %");
    EXPECT_EQ(p.legend.layers[1].range, "≥ 990 K");
    EXPECT_EQ(p.legend.layers[1].amount, "10 points, 1 %");
    EXPECT_EQ(p.legend.layers[2].amount, "0 points, 0 %");
    EXPECT_EQ(p.legend.layers[3].amount, "3 points, 0.3 %");
    EXPECT_EQ(p.legend.layers[4].amount, "1 point, 0.1 %");
    EXPECT_TRUE(p.legend.notes.empty());
    ASSERT_EQ(p.scene.layers.size(), 5u);
    EXPECT_EQ(p.scene.layers[0].runs, (std::vector<timeseries::Run>{{100, 100}}));
    EXPECT_EQ(p.scene.layers[3].runs, (std::vector<timeseries::Run>{{0, 1}, {5, 1}, {9, 1}}));
}

TEST_F(PictureOfARamp, NothingIsDrawnAndSaidWhereThereIsNoLayer) {
    Explorer e;
    e.noLayers = true;
    EXPECT_FALSE(needsSamples(e));
    const Picture none = makePicture(resolved(e, steps_), about_, 1, *step_, placed_);
    EXPECT_TRUE(none.scene.layers.empty());
    ASSERT_EQ(none.legend.notes.size(), 1u);
    EXPECT_THAT(none.legend.notes[0], HasSubstr("there is no layer"));
    Explorer hidden = withRanges({"0:9"});
    hidden.layers[0].visible = false;
    EXPECT_THAT(pictureOf(hidden).legend.notes.at(0), HasSubstr("every layer is hidden"));
    EXPECT_TRUE(pictureOf(withRanges({"0:9"})).legend.notes.empty());
}

TEST_F(PictureOfARamp, ColoursThatMixAreSaidToWhereTheyAreThick) {
    const auto mixed = [&](const Explorer& asked) {
        const Explorer e = resolved(asked, steps_);
        return isMixed(e, makeScene(e, *step_, placed_));
    };
    Explorer two = withRanges({"0:499", "500:999"});
    two.layers[0].opacity = two.layers[1].opacity = 0.3;
    EXPECT_FALSE(mixed(two)) << "in order of depth";
    two.order = render::Order::None;
    EXPECT_TRUE(mixed(two));
    Explorer thin = two;
    thin.layers[0].opacity = thin.layers[1].opacity = 0.01;
    EXPECT_FALSE(mixed(thin));
    Explorer alike = two;
    alike.layers[0].color = alike.layers[1].color = glm::dvec3(1, 0, 0);
    EXPECT_FALSE(mixed(alike));
    Explorer map = withRanges({"0:999"});
    map.order = render::Order::None;
    map.layers[0].opacity = 0.3;
    EXPECT_TRUE(mixed(map)) << "a map has many";
    map.layers[0].color = MapChoice{{}, 2000.0, 3000.0};
    EXPECT_FALSE(mixed(map)) << "of which one is left";
}

TEST_F(PictureOfARamp, IsOrderedByDepthWhereThatShows) {
    const auto orderOf = [&](const Explorer& asked) {
        return makeScene(resolved(asked, steps_), *step_, placed_).order;
    };
    Explorer two = withRanges({"0:499", "500:999"});
    EXPECT_EQ(orderOf(two), render::Order::BackToFront);
    two.layers[0].color = two.layers[1].color = glm::dvec3(1, 0, 0);
    two.layers[0].opacity = 0.9;
    EXPECT_EQ(orderOf(two), render::Order::None) << "of one colour";
    two.layers[1].color = glm::dvec3(1, 0, 0.01);
    EXPECT_EQ(orderOf(two), render::Order::BackToFront);
    two.layers[1].visible = false;
    EXPECT_EQ(orderOf(two), render::Order::None);
    two.layers[0].color = MapChoice{{}, 0.0, 999.0};
    EXPECT_EQ(orderOf(two), render::Order::BackToFront) << "a map has many";
    two.order = render::Order::None;
    EXPECT_EQ(orderOf(two), render::Order::None) << "as asked";
}

TEST_F(PictureOfARamp, AStepWithoutValuesSaysSo) {
    EXPECT_EQ(pictureOf({}).legend.emptiness, "");
    const SortedStep none =
        tests::sorted({tests::cube(10), std::vector<float>(1000), std::vector<bool>(1000, true)});
    const Picture p = makePicture(resolved({}, steps_), about_, 1, none, placed_, 0);
    EXPECT_EQ(p.legend.emptiness, "all 1,000 points of this step are missing");
}

// Two infinities beside 998 finite values: bar, map and range are those of the finite ones.
TEST_F(PictureOfARamp, InfinitiesBendNoAxis) {
    std::vector<float> values(1000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
    values[0] = -std::numeric_limits<float>::infinity();
    values[999] = std::numeric_limits<float>::infinity();
    const auto step =
        std::make_shared<const SortedStep>(tests::sorted({tests::cube(10), values, {}}));
    Explorer e = withRanges({"min:max"});
    e.layers[0].color = MapChoice{};
    e = resolved(e, {{1, step}});
    const auto& map = std::get<MapChoice>(*e.layers[0].color);
    EXPECT_EQ(map.lo, 1.0);
    EXPECT_EQ(map.hi, 998.0);
    const Picture p = makePicture(e, about_, 1, *step, placed_, 0);
    EXPECT_EQ(p.legend.layers.at(0).shown, (std::vector{std::pair{1.0, 998.0}}));
    EXPECT_EQ(p.legend.layers.at(0).amount, "1,000 points, 100 %");
    // The first choice: the uppermost tenth of the finite ones and what lies beyond them.
    const Explorer first = resolved({}, {{1, step}});
    const std::uint64_t chosen = step->count(first.layers.at(0).ranges);
    EXPECT_NEAR(static_cast<double>(chosen), 100, 10) << first.layers[0].ranges.text();
}

// Nothing lies between infinity and anything.
TEST_F(PictureOfARamp, InfinitePointsAreSaidNotToBeAmongCells) {
    std::vector<float> values(1000, 1);
    values[0] = values[5] = -std::numeric_limits<float>::infinity();
    values[999] = std::numeric_limits<float>::infinity();
    step_ = std::make_shared<const SortedStep>(tests::sorted({tests::cube(10), values, {}}));
    steps_ = {{1, step_}};
    const auto notesOf = [&](const std::vector<const char*>& ranges, Model model) {
        Explorer e = withRanges(ranges);
        e.model = model;
        return pictureOf(e).legend.notes;
    };
    EXPECT_THAT(notesOf({"min:1"}, Model::Cells),
                testing::Contains("2 of infinite value counted, not drawn: points show them"));
    EXPECT_THAT(notesOf({"min:0", "1:max"}, Model::Cells),
                testing::Contains("3 of infinite value counted, not drawn: points show them"));
    for (const auto& none : {notesOf({"(min,5]", "[0,max)"}, Model::Cells),
                             notesOf({"0:1"}, Model::Cells), notesOf({"min:max"}, Model::Points)})
        EXPECT_THAT(none, testing::Not(testing::Contains(HasSubstr("infinite"))))
            << "or none drawn";
}

// Its field has no slope that faces an eye.
TEST_F(PictureOfARamp, AFieldOfOneLayerIsNotLit) {
    for (const int layers : {1, 2}) {
        const auto grid = std::make_shared<const timeseries::Grid>(std::array<timeseries::Axis, 3>{
            timeseries::Axis{"x", "", {0, 1, 2}, false},
            timeseries::Axis{"y", "", {0, 1, 2}, false},
            timeseries::Axis{"z", "",
                             std::vector<double>(layers == 1 ? std::vector<double>{0}
                                                             : std::vector<double>{0, 1}),
                             false}});
        std::vector<float> values(grid->count());
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
        const SortedStep step = tests::sorted({grid, values, {}});
        Explorer e = withRanges({"1:5"});
        e.model = Model::Cells;
        e.layers[0].color = MapChoice{{}, 0.0, 9.0};
        e.layers[0].opacity = 0.5;
        const render::Scene scene = makeScene(e, step, render::PlacedPoints(*grid), 0);
        ASSERT_NE(scene.cells, nullptr);
        EXPECT_EQ(scene.light, layers == 1 ? render::Light::Off : render::Light::Soft);
    }
}

TEST_F(PictureOfARamp, ABoxIsToldByTheNamesOfItsAxes) {
    Explorer e = withRanges({"0:999"});
    e.clip = ClipBox{{2, -kInfinity, -kInfinity}, {4.5, kInfinity, 7}};
    const auto& axes = step_->grid().axes();
    EXPECT_THAT(pictureOf(e).legend.notes,
                testing::Contains(fmt::format("drawn inside {} 2 to 4.5 m, {} \u2264 7 m only",
                                              axes[0].name, axes[2].name)));
}

TEST_F(PictureOfARamp, AMapMayBeTurnedRound) {
    Explorer e = withRanges({"100:200"});
    e.layers[0].color = MapChoice{{}, 300.0, 100.0};
    const render::RangeStyle style = pictureOf(e).scene.layers[0].style;
    e.layers[0].color = MapChoice{{}, 100.0, 300.0};
    const render::RangeStyle ahead = pictureOf(e).scene.layers[0].style;
    for (const double v : {90.0, 100.0, 120.0, 200.0, 300.0, 310.0})
        EXPECT_EQ(colorOf(style, v), colorOf(ahead, 400 - v)) << v;
}

TEST_F(PictureOfARamp, PercentsAreOfTheValidPointsKeptOrNot) {
    step_ = ramp(0, RangeSet::parse("500:max"));
    const Picture p = pictureOf(withRanges({"500:749"}));
    EXPECT_EQ(p.legend.layers.at(0).amount, "250 points, 25 %");
    EXPECT_EQ(p.scene.layers.at(0).runs, (std::vector<timeseries::Run>{{0, 250}}));
}

TEST_F(PictureOfARamp, AskingOutsideWhatWasKeptIsRefusedInWords) {
    step_ = ramp(0, RangeSet::parse("500:max"));
    try {
        pictureOf(withRanges({"400:600"}));
        FAIL();
    } catch (const timeseries::OutsideKeptError& error) {
        EXPECT_THAT(error.what(), HasSubstr("400:600"));
        EXPECT_THAT(error.what(), HasSubstr("500:max"));
    }
}

TEST_F(PictureOfARamp, TitlesFallBackToTheNameAndLeaveOutUnitsOfNone) {
    about_.longName.clear();
    about_.units = "1";
    EXPECT_EQ(pictureOf({}).legend.title, "T");
    about_.time = std::make_shared<const timeseries::TimeAxis>(
        timeseries::TimeAxis{"step", "", "", {{0, ""}, {1, ""}}, true});
    EXPECT_EQ(pictureOf({}).legend.time, "step 1 of 0–1");
}

TEST_F(PictureOfARamp, OneUncountedStepHasNoTimeToState) {
    about_.time = std::make_shared<const timeseries::TimeAxis>(
        timeseries::TimeAxis{"step", "", "", {{0, ""}}, true});
    const Picture p = makePicture(resolved({}, steps_), about_, 0, *step_, placed_);
    EXPECT_EQ(p.legend.time, "");
}

TEST_F(PictureOfARamp, NotesTellWhatWasBentToDrawIt) {
    about_.notes = {"drawn in index space"};
    Explorer e = withRanges({"0:max"});
    e.clip = parseClip("2:5,min:max,0:0");
    const Picture p = pictureOf(e);
    ASSERT_EQ(p.legend.notes.size(), 2u);
    EXPECT_EQ(p.legend.notes[0], "drawn in index space");
    EXPECT_THAT(p.legend.notes[1], HasSubstr("x 2 to 5 m, x 0 m only"));
    EXPECT_EQ(p.scene.clip.lo, glm::uvec3(2, 0, 0));
    EXPECT_EQ(p.scene.clip.hi, glm::uvec3(5, 9, 0));
    // x from 2 to 5, every y, z 0.
    EXPECT_EQ(p.legend.layers.at(0).amount, "40 points in the clip box, 4 % of all");
}

TEST_F(PictureOfARamp, HiddenLayersAreNeitherDrawnNorInTheLegend) {
    std::mt19937 random(31);
    for (int i = 0; i < 50; ++i) {
        Explorer e = withRanges({"0:9", "100:199", "500:max"});
        setSweep(e, {});
        sweepOf(e)->animation = RangeSet::parse("300:400");
        sweepOf(e)->delta = 5;
        e = resolved(e, steps_);
        const std::int64_t tick = static_cast<std::int64_t>(random() % 256);
        const Picture whole = pictureOf(e, tick);
        for (LayerChoice& layer : e.layers) layer.visible = random() % 2 == 0;
        EXPECT_FALSE(needsSamples(e));
        const Picture picture = pictureOf(e, tick);
        std::size_t shown = 0;
        for (std::size_t k = 0; k < whole.scene.layers.size(); ++k) {
            if (!e.layers[k].visible) continue;
            ASSERT_LT(shown, picture.scene.layers.size());
            EXPECT_EQ(picture.scene.layers[shown].runs, whole.scene.layers[k].runs);
            EXPECT_EQ(picture.legend.layers[shown].range, whole.legend.layers[k].range);
            ++shown;
        }
        EXPECT_EQ(picture.scene.layers.size(), shown);
        EXPECT_EQ(picture.legend.layers.size(), shown);
    }
}

TEST_F(PictureOfARamp, WhatIsHiddenMayLieOutsideWhatWasKept) {
    step_ = ramp(0, RangeSet::parse("500:max"));
    Explorer e = withRanges({"400:600", "700:800"});
    e.layers[0].visible = false;
    EXPECT_EQ(pictureOf(e).scene.layers.size(), 1u);
}

}  // namespace
}  // namespace app
