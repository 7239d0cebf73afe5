#include "app/exploration/exploration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

#include "app/choices/edits.h"
#include "app/choices/sweep_edits.h"
#include "app/picture/picture.h"
#include "app/picture/resolved.h"
#include "tests/support/exploration_desk.h"

namespace app {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::bruteForce;
using tests::layer;
using tests::World;
using timeseries::RangeSet;
using Desk = tests::ExplorationDesk;

TEST(Exploration, EditsMadeWhileAKeptRangeIsBuiltStay) {
    Desk desk;
    desk.open("a");
    desk.exploration.seek(3);
    desk.untilShown(3);
    Explorer next = desk.exploration.explorer();
    next.layers = {layer("10:20")};
    next.keep = RangeSet::parse("5:30");
    desk.exploration.edit(next);
    EXPECT_EQ(desk.exploration.explorer().layers, next.layers);
    Explorer meanwhile = desk.exploration.explorer();
    meanwhile.layers = {layer("12:30")};
    desk.exploration.edit(meanwhile);
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer().layers, meanwhile.layers);
    EXPECT_EQ(desk.exploration.explorer().keep, next.keep);
}

TEST(Exploration, CountsAreThoseOfEveryValueLookedAt) {
    const World world;
    Desk desk({{"a", world}});
    desk.open("a");
    Explorer next = desk.exploration.explorer();
    next.layers = {layer("3:20"), layer("[10,30)"), layer("40:50", false)};
    setSweep(next, timeseries::SweepSettings{.animation = RangeSet::parse("min:max"), .delta = 6});
    desk.exploration.edit(next);
    desk.exploration.seekTick(100);
    desk.exploration.seek(8);
    desk.untilShown(8);
    EXPECT_EQ(desk.exploration.explorer().play.tick, 100);
    const PointCounts counts = bruteForce(world, *desk.exploration.shown());
    EXPECT_EQ(*desk.exploration.counts(), counts);
    EXPECT_GT(counts.layers[0], 0u);
    EXPECT_LT(counts.selected, counts.layers[0] + counts.layers[1] + counts.layers[2]);
}

TEST(Exploration, ALayerOutsideWhatIsKeptIsRefusedInWordsOnce) {
    Desk desk;
    desk.open("a");
    Explorer next = desk.exploration.explorer();
    next.layers = {layer("10:20")};
    desk.exploration.edit(next);
    next.keep = RangeSet::parse("5:30");
    desk.exploration.edit(next);
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer(), next);
    const Explorer kept = next;
    next.layers = {layer("10:40")};
    for (int frame = 0; frame < 5; ++frame) desk.exploration.edit(next, "drag");
    EXPECT_EQ(desk.exploration.explorer(), kept);
    EXPECT_EQ(desk.errors().size(), 1u);
    next = kept;
    next.keep = RangeSet::parse("15:30");  // a layer reaches outside it
    desk.exploration.edit(next);
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer(), kept);
    EXPECT_EQ(desk.errors().size(), 2u);
    desk.exploration.undo();
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.counts()->kept, 64u);
}

TEST(Exploration, WhatAnEditLeavesOpenIsResolvedFromTheStepShown) {
    Desk desk;
    desk.open("a");
    Explorer next = desk.exploration.explorer();
    next.layers.push_back({.ranges = RangeSet::parse("1:2"), .color = {}, .opacity = {}});
    desk.exploration.edit(next);
    EXPECT_EQ(desk.exploration.explorer().layers.size(), 2u);
    EXPECT_FALSE(needsSamples(desk.exploration.explorer()));
    const Explorer before = desk.exploration.explorer();
    next = before;
    next.play.time.stride = 0;
    desk.exploration.edit(next);
    EXPECT_EQ(desk.exploration.explorer(), before);
    EXPECT_THAT(desk.errors(), ElementsAre(HasSubstr("stride")));
}

TEST(Exploration, ResizingIsNoStepOfUndo) {
    Desk desk;
    desk.open("a");
    desk.exploration.resize({640, 480});
    EXPECT_EQ(desk.exploration.explorer().size, glm::ivec2(640, 480));
    EXPECT_FALSE(desk.exploration.canUndo());
}

// Commands in any order, readers that come when they come: what is shown always fits itself.
TEST(Exploration, WhateverIsDoneWhatIsShownIsWholeAndCounted) {
    const std::map<std::string, World> worlds{
        {"a", {}}, {"b", {.steps = 3, .edge = 3}}, {"c", {.variables = {"P"}, .steps = 25}}};
    const std::vector<const char*> ranges{"1:20", "[10,30),40:max", "min:12", "1005:1020", "7"};
    std::mt19937 random(11);
    Desk desk(worlds, 2000);  // bytes: a few steps
    Exploration& x = desk.exploration;
    desk.open("a");
    const auto edited = [&] {
        Explorer e = x.explorer();
        switch (random() % 7) {
            case 0:
                e.layers.assign(1 + random() % 3, layer(ranges[random() % 5]));
                break;
            case 1:
                e.layers.resize(random() % 3);
                break;
            case 2:
                e.view.azimuthDegrees = static_cast<double>(random() % 360);
                break;
            case 3:
                e.variable = random() % 2 ? "T" : "P";
                break;
            case 4:
                setSweep(e, timeseries::SweepSettings{
                                .animation = RangeSet::parse("min:max"),
                                .delta = 5,
                                .timerSteps = 1 + static_cast<std::int64_t>(random() % 50)});
                break;
            case 5:
                if (sweepOf(e)) removeLayer(e, 0);
                break;
            case 6:
                e.keep = random() % 2 ? std::optional(RangeSet::parse("2:1030")) : std::nullopt;
        }
        return e;
    };
    for (int command = 0; command < 3000; ++command) {
        switch (random() % 14) {
            case 0:
            case 1:
            case 2:
            case 3:
                x.edit(edited(), random() % 2 ? "drag" : "");
                break;
            case 4:
            case 5:
                x.undo();
                break;
            case 6:
                x.redo();
                break;
            case 7:
                x.seek(random() % 30);
                break;
            case 8:
                x.stepBy(static_cast<int>(random() % 5) - 2);
                break;
            case 9:
                x.togglePlay();
                break;
            case 10:
                x.seekTick(random() % 60);
                break;
            case 11:
                desk.startOpening(std::array{"a", "b", "c", "gone"}[random() % 4]);
                break;
            case 12:
                if (random() % 4 == 0) desk.untilOpened();
                break;
            case 13:
                if (random() % 4 == 0) x.cancelOpening();
                break;
        }
        x.advance(std::chrono::milliseconds(random() % 200));
        const Shown shown = *x.shown();
        ASSERT_FALSE(needsSamples(shown.explorer)) << command;
        ASSERT_EQ(shown.explorer.variable, shown.dataset.variable.name) << command;
        ASSERT_EQ(shown.explorer.files.front(), shown.dataset.name) << command;
        ASSERT_LT(desk.asked(), shown.dataset.stepCount()) << command;
        ASSERT_EQ(*x.counts(), bruteForce(worlds.at(shown.dataset.name), shown)) << command;
        ASSERT_EQ(sweepOf(shown.explorer) != nullptr, x.playback().sweep.has_value()) << command;
        ASSERT_LE(x.messages().size(), 100u);
    }
    if (x.playback().playing) x.togglePlay();
    desk.untilOpened();
    desk.untilShown(desk.asked());
}

}  // namespace
}  // namespace app
