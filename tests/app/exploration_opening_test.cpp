#include "app/exploration/exploration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/picture/picture.h"
#include "app/picture/resolved.h"
#include "tests/support/exploration_desk.h"
#include "tests/support/step_alone.h"

namespace app {
namespace {

using namespace std::chrono_literals;
using tests::bruteForce;
using tests::layer;
using tests::Script;
using tests::World;
using timeseries::RangeSet;
using Desk = tests::ExplorationDesk;

TEST(Exploration, OpensAFileAndShowsItsMiddleStepResolved) {
    Desk desk;
    EXPECT_FALSE(desk.exploration.shown());
    EXPECT_EQ(desk.exploration.counts(), nullptr);
    desk.startOpening("a");
    EXPECT_EQ(desk.exploration.opening(), "a");
    desk.untilOpened();
    const auto shown = desk.exploration.shown();
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->step, 5u);
    EXPECT_EQ(shown->explorer.variable, "T");
    EXPECT_EQ(shown->explorer.steps, (StepChoice{5, 5}));
    EXPECT_FALSE(needsSamples(shown->explorer));
    EXPECT_EQ(shown->explorer.layers.size(), 1u);
    EXPECT_FALSE(desk.exploration.canUndo());
}

TEST(Exploration, NothingWaitsForAReader) {
    Desk desk;
    desk.script->hold();
    desk.startOpening("a");
    desk.until([&] { return !desk.script->begun().empty(); });
    for (int frame = 0; frame < 10; ++frame) desk.exploration.advance(16ms);
    EXPECT_FALSE(desk.exploration.shown());
    EXPECT_EQ(desk.exploration.opening(), "a");
    desk.script->letGo(5);
    desk.untilOpened();
    // The reader is held again, by the survey or by these:
    desk.exploration.seek(7);
    desk.exploration.togglePlay();
    for (int frame = 0; frame < 10; ++frame) desk.exploration.advance(16ms);
    desk.choose("P");
    for (int frame = 0; frame < 10; ++frame) desk.exploration.advance(16ms);
    desk.exploration.undo();
    EXPECT_EQ(desk.shownStep(), 5u);
    desk.script->letAllGo();
}

// What a step on disk is asked for before it comes is not what it is to be asked for once its ends
// are known.
TEST(Exploration, ASweepThatIsAsWideAsTheDataOpens) {
    const std::filesystem::path file = tests::fileOf(tests::bytesOfAStep());
    for (const char* range : {"min:max", "60:max", "60:70"}) {
        Explorer wish;
        wish.files = {file};
        setSweep(wish, timeseries::SweepSettings{.animation = timeseries::RangeSet::parse(range),
                                                 .delta = 1});
        wish.play.tick = 255;
        Exploration exploration({});
        exploration.open(wish);
        while (exploration.opening()) exploration.advance(16ms);
        ASSERT_TRUE(exploration.shown()) << range;
        for (int frame = 0; frame < 3; ++frame) exploration.advance(16ms);
        EXPECT_TRUE(std::isfinite(
            timeseries::toDouble(sweepOf(exploration.explorer())->animation.ranges()[0].hi.value)));
    }
}

// Not before they are more than the budget, and not those that are looked at.
TEST(Exploration, PointsOfAStoredStepThatWerePassedMakeRoom) {
    const std::filesystem::path file = tests::fileOf(tests::bytesOfAStep());
    for (const bool all : {false, true})
        for (const std::uint64_t budget : {std::uint64_t{1} << 21, std::uint64_t{1} << 30}) {
            Exploration exploration({.budgetBytes = budget});
            exploration.open(std::vector{file});
            while (exploration.opening()) exploration.advance(16ms);
            Explorer next = exploration.explorer();
            next.layers = {layer("60:62"), layer(all ? "min:max" : "70:71")};
            next.layers[1].visible = false;
            exploration.edit(next);
            const auto before = exploration.shown()->sorted;
            const PointCounts counts = *exploration.counts();
            (void)before->columns();  // as a window does that went through all values
            ASSERT_GT(before->pointBytes(), 2'500'000u);
            const bool makesRoom = !all && budget < before->pointBytes();
            exploration.advance(16ms);
            EXPECT_EQ(exploration.shown()->sorted, before) << "that is made beside the interface";
            while (makesRoom && exploration.shown()->sorted == before) exploration.advance(16ms);
            for (int frame = 0; frame < 3; ++frame) exploration.advance(16ms);
            const auto after = exploration.shown()->sorted;
            EXPECT_EQ(after != before, makesRoom);
            EXPECT_EQ(after->file(), before->file());
            EXPECT_EQ(*exploration.counts(), counts);
            if (after == before) continue;
            const auto looked = after->select(RangeSet::parse("60:62,70:71"));
            const std::uint64_t kept = std::max(budget / 4, after->pointBytes(looked));
            EXPECT_GE(after->pointBytes(), after->pointBytes(looked));
            EXPECT_LT(exploration.series()->bytes(), kept + 100'000);
            for (int frame = 0; frame < 3; ++frame) {
                (void)after->columns(after->select(next.layers[0].ranges));
                exploration.advance(16ms);
                EXPECT_EQ(exploration.shown()->sorted, after);
            }
        }
}

TEST(Exploration, AnotherFileHasAFirstChoiceOfItsOwnAndTheLookOfTheMomentItIsThere) {
    Desk desk({{"a", {}}, {"b", {}}});
    desk.open("a");
    Explorer next = desk.exploration.explorer();
    next.layers = {layer("3:4"), layer("5:6")};
    setSweep(next, timeseries::SweepSettings{.animation = RangeSet::parse("1:2")});
    desk.exploration.edit(next);
    desk.startOpening("b");
    next = desk.exploration.explorer();
    next.view.azimuthDegrees = 12;
    next.order = render::Order::None;
    desk.exploration.edit(next);
    desk.untilOpened();
    const Explorer& now = desk.exploration.explorer();
    EXPECT_EQ(now.files.front(), "b");
    EXPECT_EQ(now.view, next.view);
    EXPECT_EQ(now.order, next.order);
    EXPECT_EQ(now.layers.size(), 1u);
    EXPECT_FALSE(sweepOf(now));
}

// How it is drawn is the look, too.
TEST(Exploration, AnotherFileIsDrawnAsTheOneBeforeWas) {
    Desk desk({{"a", {}}, {"b", {}}});
    desk.open("a");
    Explorer look = desk.exploration.explorer();
    look.model = Model::Points;
    look.light = render::Light::Full;
    look.lamp = LampChoice{10, 20};
    look.opacityPer = render::OpacityPer::Length;
    look.footprint = {.kernel = render::Kernel::Point, .size = 5};
    look.order = render::Order::None;
    look.legend = false;
    look.stereo.mode = Stereo::SideBySide;
    look.view.azimuthDegrees = 12;
    desk.exploration.edit(look);
    desk.open("b");
    // All that is not of the data.
    Explorer drawn = desk.exploration.explorer();
    EXPECT_EQ(drawn.files.front(), "b");
    drawn.files = look.files;
    drawn.layers = look.layers;
    EXPECT_EQ(drawn, look);
}

TEST(Exploration, AnotherVariableHasAFirstChoiceOfItsOwnAndUndoComesBackAcrossIt) {
    const World world;
    Desk desk({{"a", world}});
    desk.open("a");
    Explorer edited = desk.exploration.explorer();
    edited.layers = {layer("3:20")};
    edited.view.azimuthDegrees = 77;
    desk.exploration.edit(edited);
    edited = desk.exploration.explorer();
    desk.choose("P");
    EXPECT_EQ(desk.exploration.opening(), "P");
    EXPECT_EQ(desk.exploration.explorer(), edited);  // until it is there
    desk.untilOpened();
    const Explorer other = desk.exploration.explorer();
    EXPECT_EQ(other.variable, "P");
    EXPECT_EQ(other.steps, edited.steps);
    EXPECT_EQ(other.view, edited.view);
    EXPECT_NE(other.layers, edited.layers);
    EXPECT_EQ(*desk.exploration.counts(), bruteForce(world, *desk.exploration.shown()));
    desk.exploration.undo();
    EXPECT_EQ(desk.exploration.explorer(), other);
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer(), edited);
    EXPECT_EQ(*desk.exploration.counts(), bruteForce(world, *desk.exploration.shown()));
    desk.exploration.redo();
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer(), other);
}

TEST(Exploration, ARedoOfNothingLeavesAnOpeningAloneAndUndoCancelsIt) {
    Desk desk;
    desk.open("a");
    const Explorer before = desk.exploration.explorer();
    EXPECT_FALSE(desk.exploration.canUndo());
    desk.choose("P");
    desk.exploration.redo();
    EXPECT_TRUE(desk.exploration.opening());
    EXPECT_TRUE(desk.exploration.canUndo());
    desk.exploration.undo();
    EXPECT_FALSE(desk.exploration.opening());
    EXPECT_EQ(desk.exploration.explorer(), before);
}

TEST(Exploration, UndoAcrossDataLeavesTheWindowsSizeAlone) {
    Desk desk;
    desk.open("a");
    desk.choose("P");
    desk.untilOpened();
    desk.exploration.undo();
    desk.exploration.resize({320, 200});
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer().variable, "T");
    EXPECT_EQ(desk.exploration.explorer().size, glm::ivec2(320, 200));
}

TEST(Exploration, UndoAcrossDataBringsASweepBackWhereItStood) {
    Desk desk;
    desk.open("a");
    Explorer swept = desk.exploration.explorer();
    timeseries::SweepSettings sweep;
    sweep.animation = timeseries::RangeSet::parse("0:10");
    sweep.delta = 1;
    setSweep(swept, sweep);
    swept.play.tick = 9;
    desk.exploration.edit(swept);
    swept = desk.exploration.explorer();
    EXPECT_EQ(swept.play.tick, 9);
    desk.choose("P");
    desk.untilOpened();
    EXPECT_EQ(sweepOf(desk.exploration.explorer()), nullptr);
    desk.exploration.undo();
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer(), swept);
}

TEST(Exploration, UndoTwiceGoesPastDataThatAreNotThereYet) {
    Desk desk;
    desk.open("a");
    const Explorer first = desk.exploration.explorer();
    desk.choose("P");
    desk.untilOpened();
    desk.choose("T");
    desk.untilOpened();
    desk.exploration.undo();  // towards P
    EXPECT_TRUE(desk.exploration.opening());
    desk.exploration.undo();  // to T, which is what is shown
    EXPECT_FALSE(desk.exploration.opening());
    EXPECT_EQ(desk.exploration.explorer(), first);
    EXPECT_FALSE(desk.exploration.canUndo());
    desk.exploration.redo();
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer().variable, "P");
}

TEST(Exploration, AnEditWhileUndoneDataAreOpenedIsTheNewerWish) {
    Desk desk;
    desk.open("a");
    desk.choose("P");
    desk.untilOpened();
    desk.exploration.undo();
    Explorer next = desk.exploration.explorer();
    next.view.azimuthDegrees = 5;
    desk.exploration.edit(next);
    EXPECT_FALSE(desk.exploration.opening());
    EXPECT_EQ(desk.exploration.explorer(), next);
}

TEST(Exploration, ACancelledOpeningLeavesNoTrace) {
    Desk desk({{"a", {}}, {"b", {}}});
    desk.open("a");
    desk.untilAllSeen();
    const Explorer before = desk.exploration.explorer();
    desk.script->hold();
    desk.startOpening("b");
    desk.until([&] { return desk.script->begun().size() > 10; });  // its first step
    desk.exploration.cancelOpening();
    EXPECT_FALSE(desk.exploration.opening());
    desk.script->letAllGo();
    desk.script->waitUntilReadersEnded(1);
    desk.exploration.advance(0ns);
    EXPECT_EQ(desk.exploration.explorer(), before);
    EXPECT_TRUE(desk.exploration.messages().empty());
}

TEST(Exploration, EndsWhileItsReadersRead) {
    std::shared_ptr<Script> script;
    {
        Desk desk;
        script = desk.script;
        desk.open("a");
        desk.untilAllSeen();
        script->hold();
        desk.choose("P");
        desk.until([&] { return script->begun().size() > 10; });
    }
    script->letAllGo();
    script->waitUntilReadersEnded(2);
}

TEST(Exploration, AxesThatAreChosenAreThoseOfWhatIsShownAndUndoComesBack) {
    Desk desk({{"a", {}}, {"b", {}}});
    desk.open("a");
    const Explorer before = desk.exploration.explorer();
    const auto shownAxis = [&] { return desk.exploration.shown()->sorted->grid().axes()[2]; };
    const timeseries::Axis file = shownAxis();
    Explorer next = before;
    next.axes[2] = {true, "depth"};
    desk.exploration.edit(next);
    EXPECT_EQ(desk.exploration.explorer(), before) << "not yet";
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer(), next) << "and nothing else";
    EXPECT_EQ(shownAxis().name, "depth");
    EXPECT_EQ(shownAxis().down, !file.down);
    desk.exploration.undo();
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer(), before);
    EXPECT_EQ(shownAxis(), file);
    desk.exploration.redo();
    desk.untilOpened();
    // Other files say for themselves.
    next.files = {"b"};
    desk.exploration.edit(next);
    desk.untilOpened();
    EXPECT_EQ(shownAxis(), file);
}

TEST(Exploration, ASessionOpensAsItSays) {
    Desk desk({{"a", {}}, {"b", {.steps = 20}}});
    desk.open("a");
    Explorer session;
    session.files = {"b"};
    session.variable = "P";
    session.steps = StepChoice{3, 11, 4};
    session.layers = {layer("1010:1020")};
    session.view.azimuthDegrees = -9;
    desk.exploration.open(session);
    desk.untilOpened();
    const Explorer& now = desk.exploration.explorer();
    EXPECT_EQ(now.files, session.files);
    EXPECT_EQ(now.layers, session.layers);
    EXPECT_EQ(now.view, session.view);
    EXPECT_EQ(desk.shownStep(), 3u);
    // Several steps are what plays.
    EXPECT_EQ(now.play.time.first, 3u);
    EXPECT_EQ(now.play.time.last, 11u);
    EXPECT_EQ(now.play.time.stride, 4u);
    EXPECT_TRUE(desk.exploration.canUndo());
}

// As of data that have become fewer.
TEST(Exploration, AStepThatASessionNamesAndNobodyHasIsTold) {
    Desk desk({{"b", {.steps = 20}}});
    Explorer session;
    session.files = {"b"};
    session.steps = StepChoice{25, 25};
    desk.exploration.open(session);
    desk.untilOpened();
    EXPECT_EQ(desk.shownStep(), 19u);
    EXPECT_THAT(desk.errors(),
                testing::ElementsAre("There is no step 25: the last one, 19, is shown"));
}

// As of a variable that has fewer than the one before.
TEST(Exploration, AnEditToFewerStepsIsShownAtTheLastWithoutAWord) {
    Desk desk({{"a", {.steps = 30}}, {"b", {.steps = 20}}});
    desk.open("a");
    desk.exploration.seek(25);
    Explorer next = desk.exploration.explorer();
    next.files = {"b"};
    desk.exploration.edit(next);
    desk.untilOpened();
    EXPECT_EQ(desk.shownStep(), 19u);
    EXPECT_THAT(desk.errors(), testing::IsEmpty());
}

}  // namespace
}  // namespace app
