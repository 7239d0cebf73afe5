// The controls of the swept window.
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <set>

#include "tests/ui/demo_values.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

using app::panels::Rect;
using timeseries::toDouble;

class DeskSweeps : public DeskWithFire {
 protected:
    // A window so high that all fields used are seen; the sweep on, and alone: Play, Values.
    void startSweep() {
        desk_->resize(Screen::kSize);
        look(1);
        desk_->click(pageRow(side_, 0).centre());
        desk_->settled();
        look(2);  // the window is listed before the layer
    }
    // A field of the sweep's rows, which come after the four rows of time and "Sweep values".
    glm::vec2 field(std::size_t i) const {
        const Rect row = pageRow(side_, 5 + i, 1);
        return {row.min.x + 20, row.centre().y};
    }
    // Plays until the window has moved, and pauses; what is shown then.
    app::Explorer playOn() {
        const std::string title = desk_->title();
        desk_->press("space");
        desk_->waitFor("the window moves", [&] { return desk_->title() != title; });
        desk_->press("space");
        return now();
    }
    // The window's middle: between the ends of the animation on a cosine.
    static double middleOf(const app::Explorer& e) {
        const auto range = app::sweepOf(e)->animation.ranges()[0];
        const double turn = static_cast<double>(e.play.tick * app::sweepOf(e)->step) /
                            static_cast<double>(app::sweepOf(e)->timerSteps);
        return glm::mix(toDouble(range.lo.value), toDouble(range.hi.value),
                        0.5 - 0.5 * std::cos(2 * std::numbers::pi * turn));
    }
    // The points of the layer or the window, value by value.
    static std::uint64_t countOf(const app::Explorer& e) {
        std::uint64_t count = 0;
        for (const float value : valuesAt(e.steps->first))
            count +=
                oracle::holds(e.layers.at(1).ranges.ranges(), value) ||
                        std::abs(static_cast<double>(value) - middleOf(e)) <= app::sweepOf(e)->delta
                    ? 1
                    : 0;
        return count;
    }
};

TEST_F(DeskSweeps, AllValuesSeenWhileTimeStands) {
    axisOf(*desk_);
    const std::string time = parse(desk_->title()).time;
    startSweep();
    const auto [lo, hi] = demoExtent();
    std::set<std::int64_t> ticks;
    for (int i = 0; i < 4; ++i) {
        const app::Explorer e = playOn();
        ASSERT_TRUE(app::sweepOf(e));
        ASSERT_EQ(app::sweepOf(e)->path, timeseries::SweepPath::Swing);
        const auto range = app::sweepOf(e)->animation.ranges()[0];
        EXPECT_EQ(toDouble(range.lo.value), lo);
        EXPECT_EQ(toDouble(range.hi.value), hi);
        EXPECT_EQ(points(), countOf(e)) << e.play.tick;
        EXPECT_EQ(parse(desk_->title()).time, time);
        ticks.insert(e.play.tick);
    }
    EXPECT_EQ(ticks.size(), 4u);
}

TEST_F(DeskSweeps, OnlyTheValuesTyped) {
    startSweep();
    enter(field(0), "1100:1300");
    enter(field(1), "20");
    enter(field(2), "16");
    double least = INFINITY, most = -INFINITY;
    for (int i = 0; i < 6; ++i) {
        const app::Explorer e = playOn();
        ASSERT_EQ(app::sweepOf(e)->animation.text(), "1100:1300");
        ASSERT_EQ(app::sweepOf(e)->delta, 20);
        ASSERT_EQ(app::sweepOf(e)->timerSteps, 16);
        EXPECT_EQ(points(), countOf(e)) << e.play.tick;
        least = std::min(least, middleOf(e));
        most = std::max(most, middleOf(e));
    }
    EXPECT_GE(least, 1100);
    EXPECT_LE(most, 1300);
    EXPECT_GT(most, least);
}

TEST_F(DeskSweeps, NothingThatCannotBe) {
    startSweep();
    const app::Explorer before = now();
    const glm::vec2 delta = field(1);
    const Rect below{{delta.x, delta.y + 16}, {delta.x + 200, delta.y + 50}};
    const Shot quiet = desk_->settled(below);
    enter(delta, "-20");
    desk_->waitFor("it is told", [&] { return differing(desk_->shot(below), quiet) > 1000; });
    EXPECT_TRUE(now() == before);
}

}  // namespace
}  // namespace ui
