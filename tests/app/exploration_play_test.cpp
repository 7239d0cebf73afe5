#include "app/exploration/exploration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "app/panels/time_bar.h"
#include "tests/support/exploration_desk.h"

namespace app {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using tests::bruteForce;
using tests::World;
using timeseries::RangeSet;
using Desk = tests::ExplorationDesk;

TEST(Exploration, ASoughtStepIsLoadedAndUndoGoesBack) {
    Desk desk;
    desk.open("a");
    desk.script->hold();
    desk.exploration.seek(2);
    desk.exploration.advance(0ns);
    EXPECT_EQ(desk.asked(), 2u);
    if (desk.shownStep() != 2) {  // the survey may have been there before
        EXPECT_EQ(desk.exploration.waiting(), "requested step 2, showing 5");
    }
    desk.script->letAllGo();
    desk.untilShown(2);
    EXPECT_EQ(desk.exploration.waiting(), "");
    desk.exploration.undo();
    desk.untilShown(5);
    desk.exploration.redo();
    desk.untilShown(2);
    desk.exploration.seek(1000);
    EXPECT_EQ(desk.asked(), 9u);
}

TEST(Exploration, PlaysTheRealTimes) {
    // In seconds; the last step stays as long as the one before it.
    World world{.steps = 6, .times = {0, 1, 3, 3.5, 7, 8}};
    const std::vector<std::chrono::milliseconds> begins{0ms,    1000ms, 3000ms,
                                                        3500ms, 7000ms, 8000ms};
    constexpr auto kCycle = 9000ms;
    Desk desk({{"a", world}});
    desk.open("a");
    desk.untilAllSeen();
    Explorer next = desk.exploration.explorer();
    next.play.time.pace = timeseries::Pace::RealTimes;
    desk.exploration.edit(next);
    desk.exploration.seek(0);
    desk.exploration.advance(0ns);
    desk.exploration.togglePlay();
    std::mt19937 random(3);
    std::chrono::milliseconds now{0};
    for (int frame = 0; frame < 2000; ++frame) {
        const std::chrono::milliseconds dt(random() % 60);
        desk.exploration.advance(dt);
        now = (now + dt) % kCycle;
        const auto after = std::ranges::upper_bound(begins, now);
        const auto step = static_cast<std::size_t>(after - begins.begin()) - 1;
        ASSERT_EQ(desk.asked(), step) << "after " << now.count() << " ms";
        ASSERT_EQ(desk.shownStep(), step);
        const auto end = after == begins.end() ? kCycle : *after;
        ASSERT_EQ(desk.exploration.untilNextChange(), end - now);
    }
}

TEST(Exploration, PausingIsOneStepOfUndoBackToWherePlayBegan) {
    Desk desk;
    desk.open("a");
    desk.untilAllSeen();
    desk.exploration.seek(1);
    desk.exploration.togglePlay();
    for (int frame = 0; frame < 35; ++frame) desk.exploration.advance(10ms);  // 10 steps a second
    desk.exploration.togglePlay();
    EXPECT_EQ(desk.asked(), 4u);
    EXPECT_EQ(desk.exploration.untilNextChange(), std::nullopt);
    desk.exploration.undo();
    EXPECT_EQ(desk.asked(), 1u);
    desk.exploration.redo();
    EXPECT_EQ(desk.asked(), 4u);
    desk.exploration.undo();
    desk.exploration.undo();
    EXPECT_EQ(desk.asked(), 5u);
    // The same while it plays.
    desk.exploration.togglePlay();
    desk.exploration.advance(200ms);
    EXPECT_EQ(desk.asked(), 7u);
    desk.exploration.undo();
    EXPECT_EQ(desk.asked(), 5u);
    EXPECT_FALSE(desk.exploration.playback().playing);
}

TEST(Exploration, PlayGoesOnAcrossSeeksAndEdits) {
    Desk desk;
    desk.open("a");
    desk.exploration.togglePlay();
    desk.exploration.seek(2);
    Explorer next = desk.exploration.explorer();
    next.view.azimuthDegrees = 3;
    desk.exploration.edit(next);
    desk.exploration.advance(100ms);
    EXPECT_TRUE(desk.exploration.playback().playing);
    EXPECT_EQ(desk.asked(), 3u);
    desk.exploration.stepBy(-2);
    EXPECT_EQ(desk.asked(), 1u);
    desk.exploration.stepBy(-2);  // Loop goes round
    EXPECT_EQ(desk.asked(), 9u);
}

// What the picture is asked for and what the clock says, whatever is done in whichever order.
TEST(Exploration, TheStepAskedForIsAlwaysTheClocks) {
    std::mt19937 random(29);
    Desk desk({{"a", {.steps = 12}}});
    desk.open("a");
    desk.untilAllSeen();
    const auto any = [&](std::size_t n) { return random() % n; };
    const auto editTime = [&](const auto& change) {
        Explorer next = desk.exploration.explorer();
        change(next.play.time);
        desk.exploration.edit(next);
    };
    for (int i = 0; i < 3000; ++i) {
        const std::size_t what = any(13), step = any(14);
        switch (what) {
            case 0:
            case 1:
                desk.exploration.seek(step);
                EXPECT_EQ(desk.asked(), std::min<std::size_t>(step, 11));
                break;
            case 2:
                desk.exploration.stepBy(static_cast<int>(any(7)) - 3);
                break;
            case 3:
                editTime(
                    [&](auto& time) { panels::setPoint(time, panels::Point::In, desk.asked()); });
                break;
            case 4:
                editTime(
                    [&](auto& time) { panels::setPoint(time, panels::Point::Out, desk.asked()); });
                break;
            case 5:
                editTime([&](auto& time) { time.stride = 1 + any(4); });
                break;
            case 6:
                editTime([&](auto& time) {
                    time.ending = static_cast<timeseries::Ending>(any(3));
                    time.direction = static_cast<timeseries::Direction>(any(2));
                });
                break;
            case 7:
                desk.exploration.togglePlay();
                break;
            case 8:
            case 9:
                desk.exploration.advance(std::chrono::milliseconds(any(300)));
                break;
            case 10:
                if (desk.exploration.canUndo()) desk.exploration.undo();
                break;
            case 11:
                if (desk.exploration.canRedo()) desk.exploration.redo();
                break;
            case 12: {
                Explorer next = desk.exploration.explorer();
                next.play.timeMoves = !next.play.timeMoves;
                desk.exploration.edit(next);
            }
        }
        ASSERT_EQ(desk.asked(), desk.exploration.playback().time->step())
            << "operation " << i << ", of the kind " << what;
    }
}

TEST(Exploration, InAndOutPointsAreSetFromWhereverOneGoes) {
    Desk desk;
    desk.open("a");
    const auto set = [&](panels::Point point) {
        Explorer next = desk.exploration.explorer();
        panels::setPoint(next.play.time, point, desk.exploration.playback().time->step());
        desk.exploration.edit(next);
    };
    desk.exploration.seek(4);
    set(panels::Point::In);
    desk.exploration.seek(6);
    set(panels::Point::Out);
    desk.exploration.seek(0);
    EXPECT_EQ(desk.exploration.playback().time->step(), 0u);
    desk.exploration.stepBy(1);
    set(panels::Point::In);
    desk.exploration.seek(8);
    set(panels::Point::Out);
    EXPECT_EQ(desk.exploration.explorer().play.time.first, 1u);
    EXPECT_EQ(desk.exploration.explorer().play.time.last, 8u);
}

TEST(Exploration, WithOneStepNothingPlaysAndThatIsTold) {
    Desk desk({{"a", {.steps = 1}}});
    desk.open("a");
    desk.exploration.togglePlay();
    EXPECT_FALSE(desk.exploration.playback().playing);
    ASSERT_EQ(desk.exploration.messages().size(), 1u);
    EXPECT_FALSE(desk.exploration.messages().front().isError);
    desk.sweep("0:64", 1);
    desk.exploration.togglePlay();
    EXPECT_TRUE(desk.exploration.playback().playing);
}

TEST(Exploration, WhereOneStepIsLeftToPlayThatIsTold) {
    const auto told = [](timeseries::CursorSettings time) {
        Desk desk;
        desk.open("a");
        Explorer next = desk.exploration.explorer();
        next.play.time = time;
        desk.exploration.edit(next);
        desk.exploration.togglePlay();
        EXPECT_FALSE(desk.exploration.playback().playing);
        EXPECT_EQ(desk.exploration.messages().size(), 1u);
        return desk.exploration.messages().front().text;
    };
    EXPECT_EQ(told({.first = 2, .last = 2}),
              "Nothing to play: one step lies between the in and the out point");
    EXPECT_EQ(told({.stride = 100}),
              "Nothing to play: every 100 steps there is one between the in and the out point");
}

TEST(Exploration, PlayGoesOnWithAnotherVariable) {
    Desk desk;
    desk.open("a");
    desk.exploration.togglePlay();
    desk.choose("P");
    desk.untilOpened();
    EXPECT_TRUE(desk.exploration.playback().playing);
    desk.exploration.advance(100ms);
    EXPECT_EQ(desk.asked(), 6u);
    desk.open("gone");
    EXPECT_TRUE(desk.exploration.playback().playing);
}

TEST(Exploration, ASweepMovesItsWindowAndKeepsItsPlaceWhenChanged) {
    const World world;
    Desk desk({{"a", world}});
    desk.open("a");
    Explorer next = desk.exploration.explorer();
    // A cycle of one second has 100 ticks.
    setSweep(
        next,
        timeseries::SweepSettings{
            .animation = RangeSet::parse("0:64"), .delta = 3, .timerSteps = 100, .frequency = 1});
    next.play.timeMoves = false;
    desk.exploration.edit(next);
    desk.exploration.togglePlay();
    for (int frame = 0; frame < 25; ++frame) desk.exploration.advance(10ms);
    EXPECT_EQ(desk.exploration.explorer().play.tick, 25);
    EXPECT_EQ(desk.asked(), 5u);
    EXPECT_EQ(*desk.exploration.counts(), bruteForce(world, *desk.exploration.shown()));
    next = desk.exploration.explorer();
    sweepOf(next)->timerSteps = 200;
    desk.exploration.edit(next);
    EXPECT_EQ(desk.exploration.explorer().play.tick, 50);
    desk.exploration.undo();
    EXPECT_EQ(desk.exploration.explorer().play.tick, 25);
}

TEST(Exploration, UpcomingStepsAreReadInPlayingOrder) {
    Desk desk;
    desk.script->hold();
    desk.startOpening("a");
    desk.script->letGo(5);
    desk.until([&] { return desk.exploration.shown().has_value(); });
    desk.exploration.togglePlay();
    desk.exploration.advance(0ns);
    desk.script->letAllGo();
    desk.untilAllSeen();
    // 5 was read to open; then whatever the loader had begun by itself, then what play comes to.
    std::vector<std::size_t> begun = desk.script->begun();
    ASSERT_EQ(begun.size(), 10u);
    const std::vector<std::size_t> order{6, 7, 8, 9, 0, 1, 2, 3, 4};
    std::vector<std::size_t> rest(begun.begin() + 1, begun.end());
    if (rest.front() != 6) {
        std::vector<std::size_t> expected = order;
        std::erase(expected, rest.front());
        expected.insert(expected.begin(), rest.front());
        EXPECT_EQ(rest, expected);
    } else {
        EXPECT_EQ(rest, order);
    }
}

TEST(Exploration, WhereLoadingIsSlowerThanPlayTheStepPassedLastIsShown) {
    // A budget of one step: nothing that play comes to is there. It does not come round.
    Desk desk({{"a", {.steps = 100}}}, 1);
    desk.open("a");
    desk.untilAllSeen();
    desk.script->hold();
    desk.exploration.togglePlay();
    std::size_t before = desk.script->begun().size();
    for (int round = 0; round < 5; ++round) {
        desk.exploration.advance(100ms);
        desk.until([&] { return desk.script->begun().size() > before; });
        const std::size_t reading = desk.script->begun()[before];
        before = desk.script->begun().size();
        desk.exploration.advance(200ms);  // play passes it
        EXPECT_NE(desk.asked(), reading);
        desk.script->letGo(reading);
        desk.untilShown(reading);
        EXPECT_EQ(desk.exploration.waiting(),
                  fmt::format("requested step {}, showing {}", desk.asked(), reading));
    }
    desk.script->letAllGo();
}

TEST(Exploration, StepsPassedByHandAreShownAsTheyComeWhereTheyAreNearer) {
    Desk desk({{"a", {}}}, 1);  // a budget of one step: nothing else is there
    desk.open("a");
    desk.untilAllSeen();
    desk.script->hold();
    const std::size_t before = desk.script->begun().size();
    desk.exploration.seek(2);
    desk.until([&] { return desk.script->begun().size() > before; });
    desk.exploration.seek(1);
    desk.exploration.advance(0ns);
    EXPECT_EQ(desk.exploration.waiting(), "requested step 1, showing 5");
    desk.script->letGo(2);
    desk.untilShown(2);
    EXPECT_EQ(desk.exploration.waiting(), "requested step 1, showing 2");
    desk.script->letGo(1);
    desk.untilShown(1);
    desk.script->letAllGo();
}

TEST(Exploration, AStepThatFailsIsToldOnceAndPassedOver) {
    Desk desk;
    desk.script->failAt(7, "a: step 7 is cut off");
    desk.open("a");
    desk.until(
        [&] { return desk.exploration.series()->state(7) == timeseries::SlotState::Failed; });
    EXPECT_THAT(desk.errors(), ElementsAre());  // nobody asked for it
    desk.exploration.seek(7);                   // tries again
    desk.until(
        [&] { return desk.exploration.series()->state(7) == timeseries::SlotState::Failed; });
    EXPECT_EQ(desk.exploration.waiting(), "step 7 is not available, showing 5");
    EXPECT_THAT(desk.errors(), ElementsAre("a: step 7 is cut off"));
    desk.until([&] {
        for (std::size_t i = 0; i < 10; ++i)
            if (i != 7 && desk.exploration.series()->summary(i) == nullptr) return false;
        return true;
    });
    desk.exploration.forgetMessage(desk.exploration.messages().back().number);
    desk.exploration.togglePlay();
    std::set<std::size_t> seen;
    for (int frame = 0; frame < 30; ++frame) {
        desk.exploration.advance(100ms);
        EXPECT_EQ(desk.shownStep(), desk.asked() == 7 ? 6 : desk.asked());
        seen.insert(desk.shownStep());
    }
    EXPECT_EQ(seen.size(), 9u);
    EXPECT_THAT(desk.errors(), ElementsAre());  // not again
}

TEST(Exploration, EveryStepIsSeenThoughOnlyOneFitsTheBudget) {
    Desk desk({{"a", {}}}, 1);
    desk.open("a");
    desk.untilAllSeen();
    const timeseries::Series& series = *desk.exploration.series();
    EXPECT_EQ(series.bytes(), series.summary(0)->bytes);
    EXPECT_EQ(desk.shownStep(), 5u);
}

}  // namespace
}  // namespace app
