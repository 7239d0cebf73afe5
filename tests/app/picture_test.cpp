#include "app/picture/picture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "app/choices/choice_text.h"
#include "tests/support/scenes.h"

namespace app {
namespace {

using testing::HasSubstr;
using timeseries::RangeSet;
using timeseries::SortedStep;

// Values 0, 1, ..., 999 on 10^3 points in grid order, and what a reader would say of them.
class PictureOfARamp : public testing::Test {
 protected:
    static std::shared_ptr<const SortedStep> ramp(double first, const RangeSet& kept) {
        std::vector<float> values(1000);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<float>(first + static_cast<double>(i));
        return std::make_shared<const SortedStep>(
            SortedStep::build({tests::cube(10), std::move(values), {}}, kept));
    }
    PictureOfARamp() {
        about_.name = "T";
        about_.longName = "temperature";
        about_.units = "K";
        about_.grid = step_->sharedGrid();
        about_.time = std::make_shared<const timeseries::TimeAxis>(
            timeseries::TimeAxis{"time", "s", "", {{0, ""}, {0.5, ""}, {1, ""}}});
    }
    Picture pictureOf(const Explorer& e, std::int64_t tick = 0) const {
        return makePicture(resolved(e, steps_), about_, 1, *step_, placed_, tick);
    }
    static Explorer withRanges(const std::vector<const char*>& ranges) {
        Explorer e;
        e.model = Model::Points;
        for (const char* range : ranges) e.layers.push_back({RangeSet::parse(range), {}, {}});
        return e;
    }

    std::shared_ptr<const SortedStep> step_ = ramp(0, RangeSet::everything());
    Steps steps_{{1, step_}};
    render::PlacedPoints placed_{step_->grid()};
    timeseries::Variable about_;
};

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

TEST(RangeLabel, SaysARangeAsPeopleDo) {
    const auto label = [](const char* text, const char* units = "K") {
        return rangeLabel(RangeSet::parse(text), units);
    };
    EXPECT_EQ(label("600:1600"), "600 to 1600 K");
    EXPECT_EQ(label("600:max"), "≥ 600 K");
    EXPECT_EQ(label("min:600"), "≤ 600 K");
    EXPECT_EQ(label("(600,max]"), "> 600 K");
    EXPECT_EQ(label("[min,600)"), "< 600 K");
    EXPECT_EQ(label("[600,1600)"), "[600, 1600) K");
    EXPECT_EQ(label("(600,1600]"), "(600, 1600] K");
    EXPECT_EQ(label("5"), "5 K");
    EXPECT_EQ(label("-3:-1"), "−3 to −1 K") << "the minus sign of the colour bar";
    EXPECT_EQ(label("min:max"), "all values");
    EXPECT_EQ(label("0:1,5:6,9:max"), "0 to 1, 5 to 6, ≥ 9 K");
    EXPECT_EQ(label("0:1", ""), "0 to 1");
    EXPECT_EQ(label("0:1", "1"), "0 to 1");
    EXPECT_EQ(rangeLabel(RangeSet(), "K"), "no values");
}

TEST(RangeLabel, LongDoublesAreRoundedAndSaidToBe) {
    const auto label = [](const char* text) { return rangeLabel(RangeSet::parse(text), "K"); };
    EXPECT_EQ(label("0.1:0.30000000000000004"), "≈ 0.1 to 0.3 K");
    EXPECT_EQ(label("1426.5184782812678:max"), "≈ ≥ 1426.518 K");
    // As many digits as tell the ends apart; integers are never rounded.
    EXPECT_EQ(label("1.00000000123:1.00000000456"), "≈ 1.000000001 to 1.000000005 K");
    EXPECT_EQ(label("0.3:0.30000000000000004"), "0.3 to 0.30000000000000004 K");
    EXPECT_EQ(label("9007199254740993:9007199254740995"), "9007199254740993 to 9007199254740995 K");
    EXPECT_EQ(label("123456.7:123456789.5"), "123456.7 to 123456789.5 K") << "no shorter so";
}

// Doubles that seven digits do not tell apart, as bounds of different ranges.
TEST(RangeLabel, BoundsThatDifferAreWrittenDifferently) {
    const double lo = 0x1p60 + 256, hi = 0x1p60 + 1024;
    const std::string label =
        rangeLabel(RangeSet({timeseries::Range{{-std::numeric_limits<double>::infinity()}, {lo}},
                             timeseries::Range{{hi}, {std::numeric_limits<double>::infinity()}}}),
                   "");
    const std::size_t comma = label.find(", ≥ ");
    ASSERT_NE(comma, label.npos) << label;
    const std::string first = label.substr(0, comma), second = label.substr(comma);
    const double shownLo = std::stod(first.substr(first.find("1."))),
                 shownHi = std::stod(second.substr(second.find("1.")));
    EXPECT_LT(shownLo, shownHi) << label;
    EXPECT_NEAR(shownLo, lo, 1e3);
    EXPECT_NEAR(shownHi, hi, 1e3);
}

TEST(RangeLabel, AnInfiniteValueAloneIsNotAllValues) {
    EXPECT_EQ(rangeLabel(RangeSet::parse("max:max"), "K"), "inf K");
    EXPECT_EQ(rangeLabel(RangeSet::parse("min:min"), "K"), "−inf K");
    EXPECT_EQ(rangeLabel(RangeSet::parse("min:min,max:max"), ""), "−inf, inf");
}

bool nothingOpen(const Explorer& e) {
    const auto closed = [](const LayerChoice& layer) {
        if (!layer.color || !layer.opacity) return false;
        const auto* map = std::get_if<MapChoice>(&*layer.color);
        return map == nullptr || (map->lo && map->hi);
    };
    if (e.sweep && !closed(e.sweepLayer)) return false;
    return (e.sweep || !e.layers.empty()) && std::ranges::all_of(e.layers, [&](const auto& layer) {
               return closed(layer) && !layer.ranges.empty();
           });
}

TEST_F(PictureOfARamp, ResolvedLeavesNothingOpenAndIsIdempotent) {
    std::mt19937 random(12);
    const char* const ranges[] = {"0:10",    "min:max", "900:max", "2000:3000",
                                  "max:max", "5",       "1:2,4:5", "(min,3)"};
    for (int i = 0; i < 400; ++i) {
        Explorer e;
        const auto maybe = [&] { return random() % 2 == 0; };
        const auto style = [&](RangeSet set) {
            LayerChoice layer{std::move(set), {}, {}};
            if (maybe()) layer.opacity = 0.25;
            if (random() % 3 == 0) layer.color = glm::dvec3(1, 0, 0);
            if (random() % 3 == 0) {
                MapChoice map;
                if (maybe()) map.lo = 1;
                if (maybe()) map.hi = 2;
                layer.color = map;
            }
            return layer;
        };
        if (random() % 3 == 0) {
            e.sweep.emplace();
            e.sweep->animation = RangeSet::parse(ranges[random() % 2]);
            e.sweepLayer = style({});
        }
        for (std::size_t n = random() % 4; n > 0; --n)
            e.layers.push_back(style(maybe() ? RangeSet::parse(ranges[random() % 8]) : RangeSet()));
        Steps steps = steps_;
        if (random() % 8 == 0) steps.clear();
        if (random() % 4 == 0) {
            e.keep = RangeSet::parse("100:200");
            steps = {{1, ramp(0, *e.keep)}};
        }
        const Explorer once = resolved(e, steps);
        ASSERT_TRUE(nothingOpen(once)) << "case " << i;
        EXPECT_FALSE(needsSamples(once)) << "case " << i;
        // Whatever is sampled.
        EXPECT_TRUE(resolved(once, steps) == once) << "case " << i;
        EXPECT_TRUE(resolved(once, {{0, ramp(5000, RangeSet::everything())}}) == once)
            << "case " << i;
        EXPECT_TRUE(resolved(once, {}) == once) << "case " << i;
    }
}

TEST_F(PictureOfARamp, WhatWasChosenIsNotResolvedAway) {
    Explorer e = withRanges({"0:10"});
    e.layers[0].color = MapChoice{*render::colorMapNamed("cividis"), 3.0, {}};
    e.layers[0].opacity = 0.125;
    const Explorer r = resolved(e, steps_);
    EXPECT_EQ(r.layers[0].opacity, 0.125);
    const auto& map = std::get<MapChoice>(*r.layers[0].color);
    EXPECT_EQ(map.map.name(), "cividis");
    EXPECT_EQ(map.lo, 3);
    EXPECT_EQ(map.hi, 10) << "the layer's own end";
}

TEST_F(PictureOfARamp, UnboundedEndsOfAMapAreTheDatas) {
    Explorer asked = withRanges({"min:max"});
    asked.layers[0].color = MapChoice{};
    const Explorer r = resolved(asked, steps_);
    const auto& map = std::get<MapChoice>(*r.layers[0].color);
    EXPECT_EQ(map.lo, 0);
    EXPECT_EQ(map.hi, 999);
}

TEST_F(PictureOfARamp, AMapThatNobodyAskedForBeginsBelowTheRange) {
    // Its dark end would not be seen on the dark ground.
    const Explorer r = resolved(withRanges({"100:200"}), steps_);
    const auto& map = std::get<MapChoice>(*r.layers[0].color);
    EXPECT_LT(*map.lo, 100);
    EXPECT_EQ(map.hi, 200);
}

TEST_F(PictureOfARamp, SeveralLayersHaveDifferentPlainColors) {
    const Explorer r = resolved(
        withRanges({"0:1", "2:3", "4:5", "6:7", "8:9", "10:11", "12:13", "14:15"}), steps_);
    for (std::size_t i = 0; i < r.layers.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_NE(std::get<glm::dvec3>(*r.layers[i].color),
                      std::get<glm::dvec3>(*r.layers[j].color));
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

// So that they stand still while time plays, and exports of single steps agree.
TEST_F(PictureOfARamp, TheColourBarsEndsDoNotDependOnTheStep) {
    using Ends = std::pair<double, double>;
    const auto chosen = [&](const char* range, std::optional<MapChoice> map = {}) {
        Explorer e = withRanges({range});
        if (map) e.layers[0].color = *map;
        return resolved(e, steps_);
    };
    const auto barOf = [&](const Explorer& e, const SortedStep& step) {
        return makePicture(e, about_, 1, step, placed_).legend.layers.at(0).shown;
    };
    const MapChoice map{{}, -50, 100};
    const auto other = ramp(-7, RangeSet::everything());
    for (const auto& [e, ends] : {
             std::pair(chosen("100:200"), Ends(100, 200)),
             std::pair(chosen("min:max", map), Ends(-50, 100)),
             std::pair(chosen("20:max", map), Ends(20, 100)),
             std::pair(chosen("min:20", map), Ends(-50, 20)),
             std::pair(chosen("900:max", map), Ends(900, 900)),
             std::pair(chosen("900:max"), Ends(900, 999)),
         }) {
        EXPECT_EQ(barOf(e, *step_), ends);
        EXPECT_EQ(barOf(e, *other), ends);
    }
}

TEST_F(PictureOfARamp, ASweepsLegendStandsStillButForItsContour) {
    Explorer e;
    e.sweep.emplace();
    e.sweep->animation = RangeSet::parse("100.123456789:899.987654321");
    e.sweep->delta = 20;
    const Explorer r = resolved(e, steps_);
    for (std::int64_t tick = 0; tick < 256; tick += 7) {
        const Picture p = makePicture(r, about_, 1, *step_, placed_, tick);
        const render::LegendLayer& told = p.legend.layers.at(0);
        EXPECT_EQ(told.shown, std::pair(100.123456789, 899.987654321));
        // To a fiftieth of the window's half width, 0.4: one decimal.
        const double contour = timeseries::ValueSweep(*r.sweep).contour(tick);
        EXPECT_EQ(told.range, fmt::format("{:.1f} ± 20 K", contour));
    }
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
    const SortedStep none = SortedStep::build(
        {tests::cube(10), std::vector<float>(1000), std::vector<bool>(1000, true)});
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
        std::make_shared<const SortedStep>(SortedStep::build({tests::cube(10), values, {}}));
    Explorer e = withRanges({"min:max"});
    e.layers[0].color = MapChoice{};
    e = resolved(e, {{1, step}});
    const auto& map = std::get<MapChoice>(*e.layers[0].color);
    EXPECT_EQ(map.lo, 1.0);
    EXPECT_EQ(map.hi, 998.0);
    const Picture p = makePicture(e, about_, 1, *step, placed_, 0);
    EXPECT_EQ(p.legend.layers.at(0).shown, (std::pair{1.0, 998.0}));
    EXPECT_EQ(p.legend.layers.at(0).amount, "1,000 points, 100 %");
    // The first choice: the uppermost tenth of the finite ones and what lies beyond them.
    const Explorer first = resolved({}, {{1, step}});
    const std::uint64_t chosen = step->count(first.layers.at(0).ranges);
    EXPECT_NEAR(static_cast<double>(chosen), 100, 10) << first.layers[0].ranges.text();
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
    EXPECT_THAT(p.legend.notes[1], HasSubstr("2:5,min:max,0:0"));
    EXPECT_EQ(p.scene.clip.lo, glm::uvec3(2, 0, 0));
    EXPECT_EQ(p.scene.clip.hi, glm::uvec3(5, 9, 0));
    // x from 2 to 5, every y, z 0.
    EXPECT_EQ(p.legend.layers.at(0).amount, "40 points in the clip box, 4 % of all");
}

TEST_F(PictureOfARamp, TheSweptWindowIsTheFirstLayerOfEachTick) {
    Explorer e = withRanges({"0:9"});
    e.sweep.emplace();
    e.sweep->animation = RangeSet::parse("100:200");
    e.sweep->delta = 5;
    e.sweep->timerSteps = 11;
    e.sweep->path = timeseries::SweepPath::Loop;
    for (std::int64_t tick = 0; tick < 11; ++tick) {
        const Picture p = pictureOf(e, tick);
        ASSERT_EQ(p.scene.layers.size(), 2u);
        // Contours 100, 110, ..., 200, and 5 to either side.
        const auto centre = static_cast<std::uint64_t>(100 + 10 * tick);
        ASSERT_EQ(p.scene.layers[0].runs.size(), 1u);
        EXPECT_EQ(p.scene.layers[0].runs[0], (timeseries::Run{centre - 5, 11})) << tick;
        EXPECT_EQ(p.scene.layers[1].runs, (std::vector<timeseries::Run>{{0, 10}}));
        EXPECT_EQ(p.legend.layers[0].amount, "11 points, 1.1 %");
    }
}

TEST_F(PictureOfARamp, TheSweptWindowIsCutToWhatWasKept) {
    step_ = ramp(0, RangeSet::parse("150:160"));
    Explorer e;
    e.keep = RangeSet::parse("150:160");
    e.sweep.emplace();
    e.sweep->animation = RangeSet::parse("100:200");
    e.sweep->delta = 5;
    e.sweep->timerSteps = 11;
    e.sweep->path = timeseries::SweepPath::Loop;
    std::vector<std::string> amounts;
    for (std::int64_t tick = 4; tick < 8; ++tick)
        amounts.push_back(pictureOf(e, tick).legend.layers.at(0).amount);
    // 135:145, 145:155, 155:165, 165:175 of 150:160.
    EXPECT_EQ(amounts, (std::vector<std::string>{"0 points, 0 %", "6 points, 0.6 %",
                                                 "6 points, 0.6 %", "0 points, 0 %"}));
}

TEST_F(PictureOfARamp, ASweepMayStartAtAnOpenEndOfWhatWasKept) {
    // The least double above 600 is 600 as a float, which was dropped.
    const auto step = ramp(0, RangeSet::parse("(600,900)"));
    Explorer e;
    e.keep = RangeSet::parse("(600,900)");
    e.sweep.emplace();
    e.sweep->animation = *e.keep;
    e.sweep->timerSteps = 3;
    for (const double delta : {0.0, 1e-9, 2.0}) {
        e.sweep->delta = delta;
        const Explorer whole = resolved(e, {{1, step}});
        for (std::int64_t tick = 0; tick < 3; ++tick) {
            const Picture picture = makePicture(whole, about_, 1, *step, placed_, tick);
            EXPECT_EQ(picture.scene.layers.size(), 1u);
        }
    }
}

TEST_F(PictureOfARamp, AMapOfARangeBeyondTheDataHasItsEndsInOrder) {
    for (const auto& [range, end] : {std::pair("2000:max", 2000.0), std::pair("min:-5", -5.0)}) {
        const Explorer e = resolved(withRanges({range}), steps_);
        const auto& map = std::get<MapChoice>(*e.layers[0].color);
        EXPECT_EQ(*map.lo, end);
        EXPECT_EQ(*map.hi, end);
    }
}

TEST_F(PictureOfARamp, OneTickAloneIsTheSweepWhereItStands) {
    Explorer e = withRanges({"0:9"});
    e.sweep.emplace();
    e.sweep->animation = RangeSet::parse("100:200");
    e.sweep->timerSteps = 11;
    e = resolved(e, steps_);
    const Explorer alone = onlyThis(e, 1, 7);
    Explorer expected = e;
    expected.steps = StepChoice{1, 1};
    expected.oneTick = true;
    expected.play.tick = 7;
    EXPECT_TRUE(alone == expected);
    EXPECT_FALSE(needsSamples(alone));
    e.sweep.reset();
    EXPECT_FALSE(onlyThis(e, 1, 7).oneTick);
}

TEST_F(PictureOfARamp, AnUnboundedSweepGoesThroughTheDatasValues) {
    Explorer e;
    e.sweep.emplace();
    e.sweep->animation = RangeSet::everything();
    EXPECT_TRUE(needsSamples(e));
    const Explorer r = resolved(e, steps_);
    EXPECT_EQ(r.sweep->animation, RangeSet::parse("0:999"));
}

TEST_F(PictureOfARamp, AnUnboundedSweepBeyondTheDataIsRefused) {
    for (const char* animation : {"2000:max", "min:-5"}) {
        Explorer e;
        e.sweep.emplace();
        e.sweep->animation = RangeSet::parse(animation);
        try {
            resolved(e, steps_);
            ADD_FAILURE() << animation;
        } catch (const std::invalid_argument& error) {
            EXPECT_THAT(error.what(), HasSubstr(animation));
            EXPECT_THAT(error.what(), HasSubstr("0 to 999"));
        }
    }
}

TEST_F(PictureOfARamp, AStyleAloneLeavesTheRangeToTheFirstChoice) {
    Explorer plain, red;
    red.layers = {{RangeSet(), glm::dvec3(1, 0, 0), 0.5}};
    const Explorer a = resolved(plain, steps_), b = resolved(red, steps_);
    EXPECT_EQ(a.layers.at(0).ranges, b.layers.at(0).ranges);
    EXPECT_EQ(std::get<glm::dvec3>(b.layers[0].color.value()), glm::dvec3(1, 0, 0));
    EXPECT_EQ(b.layers[0].opacity, 0.5);
}

TEST_F(PictureOfARamp, AMapWithoutARangeKeepsTheEndsThatWereGiven) {
    const auto endsOf = [&](std::optional<double> lo, std::optional<double> hi) {
        Explorer e;
        e.layers = {{RangeSet(), MapChoice{*render::colorMapNamed("cividis"), lo, hi}, {}}};
        return std::get<MapChoice>(*resolved(e, steps_).layers.at(0).color);
    };
    const MapChoice open = endsOf({}, {});
    const MapChoice low = endsOf(-40, {}), high = endsOf({}, 4000), both = endsOf(300, 400);
    EXPECT_EQ(*low.lo, -40);
    EXPECT_EQ(*low.hi, *open.hi);
    EXPECT_EQ(*high.lo, *open.lo);
    EXPECT_EQ(*high.hi, 4000);
    EXPECT_EQ(std::pair(*both.lo, *both.hi), std::pair(300.0, 400.0));
}

TEST_F(PictureOfARamp, HiddenLayersAreNeitherDrawnNorInTheLegend) {
    std::mt19937 random(31);
    for (int i = 0; i < 50; ++i) {
        Explorer e = withRanges({"0:9", "100:199", "500:max"});
        e.sweep.emplace();
        e.sweep->animation = RangeSet::parse("300:400");
        e.sweep->delta = 5;
        e = resolved(e, steps_);
        const std::int64_t tick = static_cast<std::int64_t>(random() % 256);
        const Picture whole = pictureOf(e, tick);
        e.sweepLayer.visible = random() % 2 == 0;
        for (LayerChoice& layer : e.layers) layer.visible = random() % 2 == 0;
        EXPECT_FALSE(needsSamples(e));
        const Picture picture = pictureOf(e, tick);
        std::size_t shown = 0;
        for (std::size_t k = 0; k < whole.scene.layers.size(); ++k) {
            if (!(k == 0 ? e.sweepLayer : e.layers[k - 1]).visible) continue;
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

TEST_F(PictureOfARamp, HidingALayerChangesNoColour) {
    Explorer e = withRanges({"0:9", "100:199"});
    const Explorer shown = resolved(e, steps_);
    e.layers[0].visible = false;
    const Explorer hidden = resolved(e, steps_);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(hidden.layers[k].color, shown.layers[k].color);
        EXPECT_EQ(hidden.layers[k].opacity, shown.layers[k].opacity);
    }
}

TEST_F(PictureOfARamp, TheFirstChoiceIsInsideWhatWasKept) {
    for (const char* kept : {"0:100", "950:max", "3", "(10,20)", "5000:6000"}) {
        Explorer e;
        e.keep = RangeSet::parse(kept);
        step_ = ramp(0, *e.keep);
        steps_ = {{1, step_}};
        const Picture p = pictureOf(e);  // does not throw
        EXPECT_EQ(p.scene.layers.at(0).runs.empty(), step_->size() == 0) << kept;
    }
}

}  // namespace
}  // namespace app
