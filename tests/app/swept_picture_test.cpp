// The swept window as a layer of a picture.
#include "app/choices/edits.h"
#include "app/choices/sweep_edits.h"
#include "app/picture/picture.h"
#include "app/picture/resolved.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/choices/choice_text.h"
#include "tests/support/picture_of_a_ramp.h"
#include "tests/support/scenes.h"

namespace app {
namespace {

using timeseries::RangeSet;
using namespace app::ramp;

TEST_F(PictureOfARamp, ASweepsLegendStandsStillButForItsContour) {
    Explorer e;
    setSweep(e, {});
    sweepOf(e)->animation = RangeSet::parse("100.123456789:899.987654321");
    sweepOf(e)->delta = 20;
    const Explorer r = resolved(e, steps_);
    for (std::int64_t tick = 0; tick < 256; tick += 7) {
        const Picture p = makePicture(r, about_, 1, *step_, placed_, tick);
        const render::LegendLayer& told = p.legend.layers.at(0);
        EXPECT_EQ(told.shown, std::vector{std::pair(100.123456789, 899.987654321)});
        // To a fiftieth of the window's half width, 0.4: one decimal.
        const double contour = timeseries::ValueSweep(*sweepOf(r)).contour(tick);
        EXPECT_EQ(told.range, fmt::format("{:.1f} ± 20 K", contour));
    }
}

TEST_F(PictureOfARamp, TheSweptWindowIsTheFirstLayerOfEachTick) {
    Explorer e = withRanges({"0:9"});
    setSweep(e, {});
    sweepOf(e)->animation = RangeSet::parse("100:200");
    sweepOf(e)->delta = 5;
    sweepOf(e)->timerSteps = 11;
    sweepOf(e)->path = timeseries::SweepPath::Loop;
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
    setSweep(e, {});
    sweepOf(e)->animation = RangeSet::parse("100:200");
    sweepOf(e)->delta = 5;
    sweepOf(e)->timerSteps = 11;
    sweepOf(e)->path = timeseries::SweepPath::Loop;
    std::vector<std::string> amounts;
    for (std::int64_t tick = 4; tick < 8; ++tick)
        amounts.push_back(pictureOf(e, tick).legend.layers.at(0).amount);
    // 135:145, 145:155, 155:165, 165:175 of 150:160.
    EXPECT_EQ(amounts, (std::vector<std::string>{"0 points, 0 %", "6 points, 0.6 %",
                                                 "6 points, 0.6 %", "0 points, 0 %"}));
    EXPECT_THAT(pictureOf(e, 4).legend.notes,
                testing::Contains("kept, drawn and counted: 150 to 160 K only"));
    // Windows that stay inside it need no such note.
    sweepOf(e)->animation = RangeSet::parse("155:155");
    EXPECT_THAT(pictureOf(e, 4).legend.notes,
                testing::Not(testing::Contains(testing::HasSubstr("kept, drawn"))));
}

TEST_F(PictureOfARamp, ASweepMayStartAtAnOpenEndOfWhatWasKept) {
    // The least double above 600 is 600 as a float, which was dropped.
    const auto step = ramp(0, RangeSet::parse("(600,900)"));
    Explorer e;
    e.keep = RangeSet::parse("(600,900)");
    setSweep(e, {});
    sweepOf(e)->animation = *e.keep;
    sweepOf(e)->timerSteps = 3;
    for (const double delta : {0.0, 1e-9, 2.0}) {
        sweepOf(e)->delta = delta;
        const Explorer whole = resolved(e, {{1, step}});
        for (std::int64_t tick = 0; tick < 3; ++tick) {
            const Picture picture = makePicture(whole, about_, 1, *step, placed_, tick);
            EXPECT_EQ(picture.scene.layers.size(), 1u);
        }
    }
}

TEST_F(PictureOfARamp, OneTickAloneIsTheSweepWhereItStands) {
    Explorer e = withRanges({"0:9"});
    setSweep(e, {});
    sweepOf(e)->animation = RangeSet::parse("100:200");
    sweepOf(e)->timerSteps = 11;
    e = resolved(e, steps_);
    const Explorer alone = onlyThis(e, 1, 7);
    Explorer expected = e;
    expected.steps = StepChoice{1, 1};
    expected.oneTick = true;
    expected.play.tick = 7;
    EXPECT_TRUE(alone == expected);
    EXPECT_FALSE(needsSamples(alone));
    removeLayer(e, 0);
    EXPECT_FALSE(onlyThis(e, 1, 7).oneTick);
}

}  // namespace
}  // namespace app
