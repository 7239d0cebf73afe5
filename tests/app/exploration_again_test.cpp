// Files that are opened once more while they are shown: a simulation has written on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/exploration/exploration.h"
#include "tests/support/exploration_desk.h"
#include "timeseries/readers/file_stamp.h"

namespace app {
namespace {

using tests::layer;
using Desk = tests::ExplorationDesk;

// Another variable, layers and a step of one's own.
Explorer chooseIn(Desk& desk) {
    desk.choose("P");
    desk.untilOpened();
    Explorer next = desk.exploration.explorer();
    next.layers = {layer("1010:1020"), layer("1030:1040", false)};
    next.view.azimuthDegrees = -9;
    desk.exploration.edit(next);
    desk.exploration.seek(2);
    desk.untilShown(2);
    return desk.exploration.explorer();
}

std::string lastTold(const Desk& desk) {
    const auto& messages = desk.exploration.messages();
    return messages.empty() ? "" : messages.back().text;
}

TEST(ExplorationAgain, TakesUpNewStepsAndKeepsWhatWasChosen) {
    Desk desk({{"a", {.steps = 4, .times = {0, 1, 2, 3}}}});
    desk.open("a");
    const Explorer chosen = chooseIn(desk);
    desk.worlds->at("a") = {.steps = 6, .times = {0, 1, 2, 3, 4, 5}};
    desk.startOpening("a");
    EXPECT_EQ(desk.exploration.opening(), "a") << "no variable of it";
    desk.untilOpened();
    EXPECT_TRUE(desk.exploration.explorer() == chosen);
    EXPECT_EQ(desk.exploration.series()->stepCount(), 6u);
    EXPECT_EQ(desk.shownStep(), 2u);
    EXPECT_EQ(lastTold(desk), "Read again: a, 6 steps, 2 more");
    desk.exploration.seek(5);
    desk.untilShown(5);
}

// Files before it are gone.
TEST(ExplorationAgain, ShowsTheStepOfTheSameTime) {
    Desk desk({{"a", {.steps = 4, .times = {0, 1, 2, 3}}}});
    desk.open("a");
    const Explorer chosen = chooseIn(desk);
    desk.worlds->at("a") = {.steps = 2, .times = {2, 3}};
    desk.open("a");
    EXPECT_EQ(desk.shownStep(), 0u);
    EXPECT_EQ(desk.asked(), 0u);
    EXPECT_EQ(desk.exploration.explorer().layers, chosen.layers);
    EXPECT_EQ(lastTold(desk), "Read again: a, 2 steps, 2 fewer");
}

TEST(ExplorationAgain, OpensOtherDataOfTheSameNameAsAnyOther) {
    Desk desk;
    desk.open("a");
    chooseIn(desk);
    desk.worlds->at("a") = {.variables = {"Q"}};
    desk.open("a");
    EXPECT_EQ(desk.exploration.explorer().variable, "Q");
    EXPECT_EQ(desk.exploration.explorer().layers.size(), 1u) << "a first choice";
    EXPECT_THAT(desk.errors(), testing::IsEmpty());
}

// What asked for it has been answered, and no choice was made that could be taken back.
TEST(ExplorationAgain, EndsWhatAskedForItAndIsNoStepOfUndo) {
    Desk desk({{"a", {.steps = 4, .times = {0, 1, 2, 3}}}});
    desk.open("a");
    const Explorer chosen = chooseIn(desk);
    desk.exploration.tell(std::string("b: ") + timeseries::kHasChanged, true);
    desk.exploration.tell("something else", true);
    desk.open("a");
    EXPECT_THAT(desk.errors(), testing::ElementsAre("something else"));
    EXPECT_TRUE(desk.exploration.explorer() == chosen);
    desk.exploration.undo();
    desk.untilOpened();
    EXPECT_NE(desk.exploration.explorer().layers, chosen.layers);
}

TEST(ExplorationAgain, LeavesWhatIsShownWhereNothingCanBeRead) {
    Desk desk;
    desk.open("a");
    const Explorer chosen = chooseIn(desk);
    desk.worlds->clear();
    desk.open("a");
    EXPECT_TRUE(desk.exploration.explorer() == chosen);
    EXPECT_TRUE(desk.exploration.shown());
    EXPECT_THAT(desk.errors(), testing::ElementsAre("a: cannot be opened"));
}

}  // namespace
}  // namespace app
