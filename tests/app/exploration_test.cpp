#include "app/exploration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/support/scripted_reader.h"

namespace app {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::Script;
using tests::World;
using timeseries::RangeSet;

// An Exploration of worlds by file name, and a front end that sleeps until it is woken.
class Desk {
 public:
    explicit Desk(std::map<std::string, World> worlds = {{"a", {}}},
                  std::uint64_t budgetBytes = std::uint64_t{1} << 30)
        : worlds_(std::move(worlds)),
          exploration({.budgetBytes = budgetBytes,
                       .wake = [script = script] { script->wake(); },
                       .openDataset =
                           [this](auto named, const std::string& variable) {
                               return opened(named.front().string(), variable);
                           }}) {}

    // Frames without time passing, each after something came, until it holds.
    template <typename Condition>
    void until(const Condition& holds) {
        for (exploration.advance(0ns); !holds(); exploration.advance(0ns)) script->waitForWake();
    }
    void open(const std::string& file) {
        exploration.open(std::vector<std::filesystem::path>{file});
        until([&] { return !exploration.opening(); });
    }
    void untilShown(std::size_t step) {
        until([&] { return exploration.shown()->step == step; });
    }
    Explorer now() const { return exploration.explorer(); }

    std::shared_ptr<Script> script = std::make_shared<Script>();

 private:
    Dataset opened(const std::string& name, const std::string& variable) const {
        const auto world = worlds_.find(name);
        if (world == worlds_.end()) throw timeseries::FileError(name + ": cannot be opened");
        return tests::scriptedDataset(world->second, script, name, variable);
    }
    std::map<std::string, World> worlds_;

 public:
    Exploration exploration;  // last: openings use the worlds
};

std::size_t askedStep(const Exploration& exploration) {
    return exploration.explorer().steps->first;
}

TEST(Exploration, OpensAFileAndShowsItsMiddleStepResolved) {
    Desk desk;
    EXPECT_FALSE(desk.exploration.shown());
    EXPECT_EQ(desk.exploration.counts(), nullptr);
    desk.exploration.open(std::vector<std::filesystem::path>{"a"});
    EXPECT_EQ(desk.exploration.opening(), "a");
    desk.until([&] { return !desk.exploration.opening(); });
    const auto shown = desk.exploration.shown();
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->step, 5u);
    EXPECT_EQ(shown->explorer.variable, "T");
    EXPECT_EQ(shown->explorer.steps, (StepChoice{5, 5}));
    ASSERT_EQ(shown->explorer.layers.size(), 1u);
    EXPECT_TRUE(shown->explorer.layers[0].color && shown->explorer.layers[0].opacity);
    EXPECT_EQ(desk.exploration.counts()->total, 64u);
    EXPECT_FALSE(desk.exploration.canUndo());
}

TEST(Exploration, ASoughtStepIsLoadedAndUndoGoesBack) {
    Desk desk;
    desk.open("a");
    desk.exploration.seek(2);
    EXPECT_EQ(desk.exploration.shown()->step, 5u);
    desk.untilShown(2);
    desk.exploration.undo();
    EXPECT_EQ(askedStep(desk.exploration), 5u);
    desk.untilShown(5);
    desk.exploration.redo();
    desk.untilShown(2);
}

}  // namespace
}  // namespace app
