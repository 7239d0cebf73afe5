// Time and values under the hand: on the map of values by time, on the axis beside it, on the time
// bar.
#include "tests/ui/demo_values.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

using app::panels::Rect;
using app::panels::StepAxis;
using app::panels::ValueAxis;
using timeseries::toDouble;

class DeskDrags : public DeskWithFire {
 protected:
    using DeskWithFire::DeskWithFire;

    // Presses at the first step of a way, goes from one to the next, and lets go: each is shown.
    void scrub(const StepAxis& axis, float y, const std::vector<std::size_t>& way) {
        desk_->move({axis.centre(way.front()), y});
        desk_->down();
        for (std::size_t i = 1; i < way.size(); ++i) {
            desk_->move({axis.centre(way[i]), y});
            desk_->waitFor(fmt::format("step {} is shown", way[i]),
                           [&] { return std::abs(seconds() - times_[way[i]]) < 1e-3; });
        }
        desk_->up();
        EXPECT_NEAR(seconds(), times_[way.back()], 1e-3);
    }
    StepAxis acrossTheMap() const {
        return {kDemoSteps, at_.histogramPanel.map.min.x, at_.histogramPanel.map.max.x};
    }
    std::vector<double> times_ = demoTimes();
};

TEST_F(DeskDrags, TimeAcrossTheMapEitherWayInAndBesideTheRange) {
    const app::Explorer before = now();
    const ValueAxis values = axisOf(*desk_);
    scrub(acrossTheMap(), values.y(1200), {4, 16, 25, 9});
    scrub(acrossTheMap(), values.y(800), {20, 7, 30, 0});
    app::Explorer after = now();
    EXPECT_EQ(after.steps->first, 0u);
    after.steps = before.steps;
    after.stepTime = before.stepTime;
    EXPECT_TRUE(after == before) << "but for the step";
    // It is one gesture.
    desk_->press("ctrl+z");
    desk_->waitFor("where the last drag began", [&] { return seconds() == times_[9]; });
}

TEST_F(DeskDrags, TheRangeUpTheMap) {
    const ValueAxis values = axisOf(*desk_);
    const std::string time = parse(desk_->title()).time;
    const float x = acrossTheMap().centre(10);
    desk_->drag({x, values.y(800)}, {x, values.y(1000)});
    const app::Explorer e = now();
    const timeseries::Range range = e.layers.at(0).ranges.ranges()[0];
    EXPECT_NEAR(toDouble(range.lo.value), 800, 3 * values.perPixel());
    EXPECT_NEAR(toDouble(range.hi.value), 1200, 3 * values.perPixel());
    EXPECT_EQ(points(), countIn(e));
    EXPECT_EQ(parse(desk_->title()).time, time);
}

TEST_F(DeskDrags, TimeOnTheTimeBarEitherWay) {
    const Rect& rail = at_.timeBar.rail;
    const StepAxis axis{kDemoSteps, rail.min.x, rail.max.x};
    scrub(axis, rail.centre().y, {3, 28, 11, 12});
    EXPECT_EQ(now().steps->first, 12u);
}

class DeskDragsTheWindow : public DeskDrags {
 protected:
    // Counts 400, 410, ..., 1400.
    DeskDragsTheWindow()
        : DeskDrags({"--sweep=400:1400", "--delta=100", "--timer-steps=101", "--opacity=0.3"}) {}
};

TEST_F(DeskDragsTheWindow, AlongTheAxis) {
    const ValueAxis values = axisOf(*desk_);
    const Shot before = picture();
    const float x = at_.histogramPanel.axis.centre().x;
    // Within the window at its first tick, 300 to 500, and clear of the bracket's end at 400.
    desk_->drag({x, values.y(460)}, {x, values.y(1000)});
    const Shot after = picture();
    const app::Explorer e = now();
    const double contour = 400 + 10 * static_cast<double>(e.play.tick);
    EXPECT_NEAR(contour, 1000, 5 + values.perPixel());
    std::uint64_t inside = 0;
    for (const float value : valuesAt(e.steps->first))
        inside += std::abs(static_cast<double>(value) - contour) <= 100 ? 1 : 0;
    EXPECT_EQ(points(), inside);
    EXPECT_GT(differing(after, before), 1000u);
    EXPECT_EQ(app::sweepOf(e)->animation.text(), "400:1400") << "where it goes stays";
}

}  // namespace
}  // namespace ui
