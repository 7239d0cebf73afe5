#include "app/exploration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "app/picture.h"
#include "tests/support/scripted_reader.h"
#include "tests/support/selection_oracle.h"

namespace app {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::Script;
using tests::World;
using timeseries::RangeSet;

constexpr std::uint64_t kPlenty = std::uint64_t{1} << 30;

// An Exploration of worlds by file name, and a front end that sleeps until it is woken.
class Desk {
 public:
    explicit Desk(std::map<std::string, World> worlds = {{"a", {}}},
                  std::uint64_t budgetBytes = kPlenty)
        : exploration({.budgetBytes = budgetBytes,
                       .wake = [script = script] { script->wake(); },
                       .openDataset =
                           [script = script, worlds = std::move(worlds)](
                               auto named, const std::string& variable) {
                               const std::string name = named.front().string();
                               const auto world = worlds.find(name);
                               if (world == worlds.end())
                                   throw timeseries::FileError(name + ": cannot be opened");
                               return tests::scriptedDataset(world->second, script, name, variable);
                           }}) {}

    // Frames in which no time passes, each after something came, until it holds.
    template <typename Condition>
    void until(const Condition& holds) {
        for (exploration.advance(0ns); !holds(); exploration.advance(0ns)) script->waitForWake();
    }
    void startOpening(const std::string& file) {
        exploration.open(std::vector<std::filesystem::path>{file});
    }
    void untilOpened() {
        until([&] { return !exploration.opening(); });
    }
    void open(const std::string& file) {
        startOpening(file);
        untilOpened();
    }
    void untilShown(std::size_t step) {
        until([&] { return exploration.shown()->step == step; });
    }
    void untilAllSeen() {
        until([&] {
            const timeseries::Series& series = *exploration.series();
            for (std::size_t i = 0; i < series.stepCount(); ++i)
                if (series.summary(i) == nullptr) return false;
            return true;
        });
    }
    void choose(const std::string& variable) {
        Explorer next = exploration.explorer();
        next.variable = variable;
        exploration.edit(next);
    }
    std::size_t asked() const { return exploration.explorer().steps->first; }
    std::size_t shownStep() const { return exploration.shown()->step; }
    std::vector<std::string> errors() const {
        std::vector<std::string> texts;
        for (const Exploration::Message& m : exploration.messages())
            if (m.isError) texts.push_back(m.text);
        return texts;
    }

    std::shared_ptr<Script> script = std::make_shared<Script>();
    Exploration exploration;
};

LayerChoice layer(const char* ranges, bool visible = true) {
    return {.ranges = RangeSet::parse(ranges),
            .color = glm::dvec3(1, 0, 0),
            .opacity = 0.5,
            .visible = visible};
}

// As PointCounts says it, value by value.
PointCounts bruteForce(const World& world, const Shown& shown) {
    const Explorer& e = shown.explorer;
    const auto at = std::ranges::find(world.variables, e.variable) - world.variables.begin();
    const RangeSet kept = e.keep.value_or(RangeSet::everything());
    PointCounts counts;
    counts.layers.resize(e.layers.size());
    std::optional<timeseries::Range> window;
    if (e.sweep) window = timeseries::ValueSweep(*e.sweep).window(e.play.tick);
    for (std::size_t i = 0; i < world.edge * world.edge * world.edge; ++i) {
        const float value = world.value(static_cast<std::size_t>(at), shown.step, i);
        ++counts.total;
        if (!oracle::holds(kept.ranges(), value)) continue;
        ++counts.kept;
        bool selected = false;
        if (window && oracle::holds(*window, value)) {
            ++counts.swept;
            selected = e.sweepLayer.visible;
        }
        for (std::size_t k = 0; k < e.layers.size(); ++k) {
            if (!oracle::holds(e.layers[k].ranges.ranges(), value)) continue;
            ++counts.layers[k];
            selected = selected || e.layers[k].visible;
        }
        if (selected) ++counts.selected;
    }
    return counts;
}

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

TEST(Exploration, ABadFileLeavesWhatIsShownUntouchedAndSaysWhy) {
    Desk desk;
    desk.open("a");
    const Explorer before = desk.exploration.explorer();
    const auto sorted = desk.exploration.shown()->sorted;
    desk.open("gone");
    EXPECT_EQ(desk.exploration.explorer(), before);
    EXPECT_EQ(desk.exploration.shown()->sorted, sorted);
    EXPECT_FALSE(desk.exploration.canUndo());
    EXPECT_THAT(desk.errors(), ElementsAre("gone: cannot be opened"));
    desk.exploration.forgetMessage(desk.exploration.messages().front().number);
    EXPECT_THAT(desk.errors(), ElementsAre());
}

TEST(Exploration, AnotherFileHasAFirstChoiceOfItsOwnAndTheLookOfTheMomentItIsThere) {
    Desk desk({{"a", {}}, {"b", {}}});
    desk.open("a");
    Explorer next = desk.exploration.explorer();
    next.layers = {layer("3:4"), layer("5:6")};
    next.sweep = timeseries::SweepSettings{.animation = RangeSet::parse("1:2")};
    desk.exploration.edit(next);
    desk.startOpening("b");
    next = desk.exploration.explorer();
    next.view.azimuthDegrees = 12;
    next.order = render::Order::BackToFront;
    desk.exploration.edit(next);
    desk.untilOpened();
    const Explorer& now = desk.exploration.explorer();
    EXPECT_EQ(now.files.front(), "b");
    EXPECT_EQ(now.view, next.view);
    EXPECT_EQ(now.order, next.order);
    EXPECT_EQ(now.layers.size(), 1u);
    EXPECT_FALSE(now.sweep);
}

TEST(Exploration, AFileWithoutAStepThatCanBeReadIsRefused) {
    Desk desk({{"a", {}}, {"b", {.steps = 2}}});
    desk.open("a");
    desk.untilAllSeen();
    const Explorer before = desk.exploration.explorer();
    desk.script->failAt(0, "b: step 0 is cut off");
    desk.script->failAt(1, "b: step 1 is cut off");
    desk.open("b");
    EXPECT_EQ(desk.exploration.explorer(), before);
    EXPECT_THAT(desk.errors(), ElementsAre("b: step 1 is cut off", "b: step 0 is cut off"));
}

TEST(Exploration, AFileOpensWithAnotherStepWhereTheMiddleOneFails) {
    Desk desk;
    desk.script->failAt(5, "a: step 5 is cut off");
    desk.open("a");
    ASSERT_TRUE(desk.exploration.shown());
    EXPECT_NE(desk.shownStep(), 5u);
    EXPECT_EQ(desk.asked(), 5u);
    EXPECT_THAT(desk.exploration.waiting(), HasSubstr("step 5 is not available"));
    EXPECT_THAT(desk.errors(), ElementsAre("a: step 5 is cut off"));
    desk.script->mend();
    desk.exploration.seek(5);
    desk.untilShown(5);
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

TEST(Exploration, AVariableThatIsNotThereChangesNothing) {
    Desk desk;
    desk.open("a");
    const Explorer before = desk.exploration.explorer();
    desk.choose("Q");
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer(), before);
    EXPECT_THAT(desk.errors(), ElementsAre("a: no variable 'Q'"));
}

TEST(Exploration, UndoneDataThatAreGoneLeaveTheHistoryWhereItIs) {
    Desk desk({{"a", {}}, {"b", {.steps = 2}}});
    desk.open("a");
    desk.open("b");
    desk.untilAllSeen();
    const Explorer before = desk.exploration.explorer();
    for (std::size_t step = 0; step < 10; ++step) desk.script->failAt(step, "a: is gone");
    desk.exploration.undo();
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer(), before);
    EXPECT_TRUE(desk.exploration.canUndo());
    EXPECT_THAT(desk.errors(), ElementsAre("a: is gone"));
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

TEST(Exploration, CountsAreThoseOfEveryValueLookedAt) {
    const World world;
    Desk desk({{"a", world}});
    desk.open("a");
    Explorer next = desk.exploration.explorer();
    next.layers = {layer("3:20"), layer("[10,30)"), layer("40:50", false)};
    next.sweep = timeseries::SweepSettings{.animation = RangeSet::parse("min:max"), .delta = 6};
    desk.exploration.edit(next);
    desk.exploration.seekTick(100);
    desk.exploration.seek(8);
    desk.untilShown(8);
    EXPECT_EQ(desk.exploration.explorer().play.tick, 100);
    const PointCounts counts = bruteForce(world, *desk.exploration.shown());
    EXPECT_EQ(*desk.exploration.counts(), counts);
    EXPECT_GT(counts.swept, 0u);
    EXPECT_LT(counts.selected, counts.layers[0] + counts.layers[1] + counts.swept);
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

TEST(Exploration, ASweepMovesItsWindowAndKeepsItsPlaceWhenChanged) {
    const World world;
    Desk desk({{"a", world}});
    desk.open("a");
    Explorer next = desk.exploration.explorer();
    // A cycle of one second has 100 ticks.
    next.sweep = timeseries::SweepSettings{
        .animation = RangeSet::parse("0:64"), .delta = 3, .timerSteps = 100, .frequency = 1};
    next.play.timeMoves = false;
    desk.exploration.edit(next);
    desk.exploration.togglePlay();
    for (int frame = 0; frame < 25; ++frame) desk.exploration.advance(10ms);
    EXPECT_EQ(desk.exploration.explorer().play.tick, 25);
    EXPECT_EQ(desk.asked(), 5u);
    EXPECT_EQ(*desk.exploration.counts(), bruteForce(world, *desk.exploration.shown()));
    next = desk.exploration.explorer();
    next.sweep->timerSteps = 200;
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
                e.sweep = timeseries::SweepSettings{
                    .animation = RangeSet::parse("min:max"),
                    .delta = 5,
                    .timerSteps = 1 + static_cast<std::int64_t>(random() % 50)};
                break;
            case 5:
                e.sweep.reset();
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
        ASSERT_EQ(shown.explorer.variable, shown.dataset.about.name) << command;
        ASSERT_EQ(shown.explorer.files.front(), shown.dataset.name) << command;
        ASSERT_LT(desk.asked(), shown.dataset.stepCount()) << command;
        ASSERT_EQ(*x.counts(), bruteForce(worlds.at(shown.dataset.name), shown)) << command;
        ASSERT_EQ(shown.explorer.sweep.has_value(), x.playback().sweep.has_value()) << command;
        ASSERT_LE(x.messages().size(), 100u);
    }
    if (x.playback().playing) x.togglePlay();
    desk.untilOpened();
    desk.untilShown(desk.asked());
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
