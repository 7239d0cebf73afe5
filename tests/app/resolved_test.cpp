// What is chosen where the user left it open.
#include "app/picture/resolved.h"
#include "app/choices/sweep_edits.h"
#include "app/picture/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>

#include "app/choices/choice_text.h"
#include "app/choices/layer_colors.h"
#include "tests/support/picture_of_a_ramp.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"

namespace app {
namespace {

using testing::HasSubstr;
using timeseries::RangeSet;
using namespace app::ramp;

bool nothingOpen(const Explorer& e) {
    const auto closed = [](const LayerChoice& layer) {
        if (!layer.color || !layer.opacity) return false;
        const auto* map = std::get_if<MapChoice>(&*layer.color);
        return map == nullptr || (map->lo && map->hi);
    };
    return !e.layers.empty() && std::ranges::all_of(e.layers, [&](const auto& layer) {
        return closed(layer) && layer.ranges.empty() == layer.motion.has_value();
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
            e.layers.push_back(style({}));
            e.layers.front().motion.emplace().animation = RangeSet::parse(ranges[random() % 2]);
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

// A step that has what is asked for, and no more, leads to the same choices, and shows it.
TEST_F(PictureOfARamp, WhatIsNeededOfAStepIsEnoughToChooseBy) {
    std::mt19937_64 random(12);
    const std::array ranges{"min:100", "0:10", "5:20", "(3:8)", "2000:max", "995:max", "400:600"};
    int fewer = 0;
    for (int i = 0; i < 500; ++i) {
        Explorer e;
        for (std::size_t n = random() % 4; n > 0; --n) {
            LayerChoice layer{RangeSet::parse(ranges[random() % ranges.size()]), {}, {}};
            if (random() % 3 == 0) layer.opacity = 0.25;
            if (random() % 3 == 0) layer.color = MapChoice{};
            layer.visible = random() % 3 != 0;
            e.layers.push_back(layer);
        }
        e.noLayers = e.layers.empty();
        const auto some = ramp(0, rangesNeeded(e));
        fewer += some->size() < steps_.begin()->second->size();
        const Explorer chosen = resolved(e, steps_);
        EXPECT_TRUE(resolved(e, {{0, some}}) == chosen) << "case " << i;
        EXPECT_EQ(rangesNeeded(chosen), rangesNeeded(e)) << "case " << i;
        for (const LayerChoice& layer : chosen.layers)
            EXPECT_EQ(some->count(layer.ranges), steps_.begin()->second->count(layer.ranges));
    }
    EXPECT_GT(fewer, 400);
}

TEST_F(PictureOfARamp, WhatIsLeftToChooseOrMovesMayNeedAnyValue) {
    EXPECT_EQ(rangesNeeded({}), RangeSet::everything());
    Explorer two = withRanges({"0:10", "20:30"});
    EXPECT_EQ(rangesNeeded(two), RangeSet::parse("0:10,20:30"));
    two.layers[1].visible = false;
    EXPECT_EQ(rangesNeeded(two), RangeSet::parse("0:10,20:30"));
    two.layers[1].motion.emplace().animation = RangeSet::parse("20:30");
    EXPECT_EQ(rangesNeeded(two), RangeSet::everything());
    Explorer open = withRanges({"0:10"});
    open.layers.push_back({});
    EXPECT_EQ(rangesNeeded(open), RangeSet::everything());
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

// Of so many points so many: of each class one after the other.
Explorer firstOfClasses(const std::vector<std::pair<int, std::size_t>>& classes,
                        bool categories = true) {
    std::vector<std::uint8_t> values;
    for (const auto& [value, points] : classes)
        values.insert(values.end(), points, static_cast<std::uint8_t>(value));
    timeseries::Field field{std::make_shared<const timeseries::Grid>(std::array{
                                tests::axis(values.size()), tests::axis(1), tests::axis(1)}),
                            std::move(values),
                            {}};
    field.categories = categories;
    return resolved({}, {{0, std::make_shared<const SortedStep>(tests::sorted(field))}});
}

TEST(FirstLayers, OfClassesAreOneEachButForTheMostCommon) {
    const Explorer e = firstOfClasses({{0, 50}, {2, 10}, {1, 1}, {255, 20}});
    ASSERT_EQ(e.layers.size(), 3u);
    std::set<std::array<double, 3>> colors;
    const char* const ranges[] = {"1", "2", "255"};
    for (std::size_t i = 0; i < e.layers.size(); ++i) {
        EXPECT_EQ(e.layers[i].ranges, RangeSet::parse(ranges[i]));
        const auto& color = std::get<glm::dvec3>(*e.layers[i].color);
        colors.insert({color.r, color.g, color.b});
    }
    EXPECT_EQ(colors.size(), 3u);
    // The most common that have colours; a mask, and what is no class, are chosen from as ever.
    std::vector<std::pair<int, std::size_t>> many{{100, 1000}};
    for (int i = 0; i < static_cast<int>(kLayerColors.size()); ++i) many.emplace_back(i, 10);
    EXPECT_EQ(firstOfClasses(many).layers.size(), kLayerColors.size());
    many.insert(many.begin() + 1, {200, 11});
    many.emplace_back(220, 9);
    const Explorer some = firstOfClasses(many);
    ASSERT_EQ(some.layers.size(), kLayerColors.size());
    EXPECT_EQ(some.layers.front().ranges, RangeSet::parse("0"));
    EXPECT_EQ(some.layers.back().ranges, RangeSet::parse("200"));
    many.emplace_back(221, 8);
    EXPECT_EQ(firstOfClasses(many).layers, some.layers);
    EXPECT_EQ(firstOfClasses({{0, 50}, {1, 10}}).layers.size(), 1u);
    EXPECT_EQ(firstOfClasses({{7, 50}}).layers.size(), 1u);
    EXPECT_EQ(firstOfClasses({{0, 50}, {2, 10}, {1, 1}, {255, 20}}, false).layers.size(), 1u);
}

TEST_F(PictureOfARamp, AMapOfARangeBeyondTheDataHasItsEndsInOrder) {
    for (const auto& [range, end] : {std::pair("2000:max", 2000.0), std::pair("min:-5", -5.0)}) {
        const Explorer e = resolved(withRanges({range}), steps_);
        const auto& map = std::get<MapChoice>(*e.layers[0].color);
        EXPECT_EQ(*map.lo, end);
        EXPECT_EQ(*map.hi, end);
    }
}

TEST_F(PictureOfARamp, AnUnboundedSweepGoesThroughTheDatasValues) {
    Explorer e;
    setSweep(e, {});
    sweepOf(e)->animation = RangeSet::everything();
    EXPECT_TRUE(needsSamples(e));
    const Explorer r = resolved(e, steps_);
    EXPECT_EQ(sweepOf(r)->animation, RangeSet::parse("0:999"));
}

TEST_F(PictureOfARamp, AnUnboundedSweepBeyondTheDataIsRefused) {
    for (const char* animation : {"2000:max", "min:-5"}) {
        Explorer e;
        setSweep(e, {});
        sweepOf(e)->animation = RangeSet::parse(animation);
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

// Doubles there are 256 apart.
TEST(ResolvedSweep, OfIntegersBeyondDoublesEndsAtTheirOwnEnds) {
    const std::int64_t first = (std::int64_t{1} << 60) + 1;
    std::vector<std::int64_t> values(1000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = first + std::int64_t(i);
    const auto step =
        std::make_shared<const SortedStep>(tests::sorted({tests::cube(10), values, {}}));
    for (const bool keeps : {false, true}) {
        Explorer e;
        if (keeps) e.keep = timeseries::RangeSet::everything();
        setSweep(e, timeseries::SweepSettings{.animation = timeseries::RangeSet::everything(),
                                              .delta = 10,
                                              .timerSteps = 1000,
                                              .path = timeseries::SweepPath::Loop});
        e = resolved(e, {{0, step}});
        const timeseries::ValueSweep sweep(*sweepOf(e));
        for (std::int64_t tick = 0; tick < 1000; ++tick) {
            const std::int64_t below = std::min<std::int64_t>(tick, 10),
                               above = std::min<std::int64_t>(999 - tick, 10);
            ASSERT_EQ(step->count(timeseries::RangeSet(std::vector{sweep.window(tick)})),
                      std::uint64_t(below + above + 1))
                << tick;
        }
    }
}

}  // namespace
}  // namespace app
