// What cannot be opened, or read any more: told, and what is shown stays where it can.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/built_paths.h"
#include "tests/support/exploration_desk.h"
#include "tests/support/step_alone.h"

namespace app {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using Desk = tests::ExplorationDesk;

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

// A bit of each block's points or values wrong.
std::filesystem::path damagedStep(bool values) {
    auto bytes = tests::bytesOfAStep();
    const auto file = tests::opened(bytes);
    for (const timeseries::StepBlock& block : file->blocks())
        bytes[values ? block.keysAt : block.idsAt] ^= std::byte{1};
    return tests::fileOf(bytes);
}

// Its points are read where somebody looks: damage comes to light late.
TEST(Exploration, AStepThatCanBeReadNoLongerIsToldAndClosed) {
    Exploration exploration({});
    exploration.open(std::vector{damagedStep(false)});
    while (exploration.opening()) exploration.advance(16ms);
    ASSERT_TRUE(exploration.shown()) << exploration.messages().back().text;
    const auto shown = exploration.shown()->sorted;
    EXPECT_FALSE(exploration.reading([&] { (void)shown->columns(); }));
    EXPECT_TRUE(exploration.shown()) << "somebody may be drawing it";
    exploration.advance(16ms);
    EXPECT_THAT(exploration.messages().back().text,
                AllOf(HasSubstr("u.isostep is a damaged sorted step"),
                      HasSubstr("nothing is shown any more")));
    EXPECT_FALSE(exploration.shown());
    EXPECT_EQ(exploration.explorer(), Explorer());
    EXPECT_FALSE(exploration.canUndo());
    exploration.advance(16ms);
    EXPECT_FALSE(exploration.shown());
}

TEST(Exploration, AStepThatCannotBeSelectedFromIsRefusedAndWhatIsShownStays) {
    Exploration exploration({});
    exploration.open(std::vector{tests::demo()});
    while (exploration.opening()) exploration.advance(16ms);
    exploration.open(std::vector{damagedStep(true)});
    while (exploration.opening()) exploration.advance(16ms);
    EXPECT_THAT(exploration.messages().back().text,
                HasSubstr("u.isostep is a damaged sorted step"));
    ASSERT_TRUE(exploration.shown());
    EXPECT_EQ(exploration.shown()->dataset.variable.name, "T");
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

TEST(Exploration, AClipBoxWithoutAPointIsToldAndLeftOut) {
    Desk desk;
    Explorer wish;
    wish.files = {"a"};
    wish.clip = ClipBox{glm::dvec3(1e6), glm::dvec3(2e6)};
    desk.exploration.open(wish);
    desk.untilOpened();
    EXPECT_FALSE(desk.exploration.explorer().clip);
    EXPECT_THAT(desk.errors(), ElementsAre(HasSubstr("holds no point")));
}

TEST(Exploration, AGlobeOfNoLongitudesIsToldAndLeftOut) {
    Desk desk;
    Explorer wish;
    wish.files = {"a"};
    wish.map = render::Map::Globe;
    desk.exploration.open(wish);
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer().map, render::Map::Flat);
    EXPECT_THAT(desk.errors(), ElementsAre(HasSubstr("longitudes and latitudes")));
    // Nor is it chosen later.
    wish = desk.exploration.explorer();
    wish.map = render::Map::Globe;
    desk.exploration.edit(wish);
    EXPECT_EQ(desk.exploration.explorer().map, render::Map::Flat);
}

}  // namespace
}  // namespace app
