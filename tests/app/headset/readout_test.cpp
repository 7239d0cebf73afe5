#include "app/headset/readout.h"

#include <gmock/gmock.h>

#include "tests/support/scripted_exploration.h"

namespace app::headset {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Readout, SaysWhatIsShown) {
    tests::ScriptedExploration world({.steps = 3, .times = {0, 0.5, 1}});
    Exploration& e = world.exploration;
    Explorer next = e.explorer();
    next.layers = {
        {.ranges = timeseries::RangeSet::parse("3:5"), .color = glm::dvec3(1), .opacity = 0.5}};
    e.edit(next);
    const std::string text = readoutText(e, {}, 1);
    // Values 0 to 63, each once.
    EXPECT_THAT(text, HasSubstr("T 3 to 5"));
    EXPECT_THAT(text, HasSubstr("step"));
    EXPECT_THAT(text, HasSubstr("\n3 points"));
    EXPECT_THAT(text, Not(HasSubstr("resolution")));
    EXPECT_THAT(text, Not(HasSubstr("playing")));
}

TEST(Readout, FollowsTheSweptWindow) {
    tests::ScriptedExploration world;
    Exploration& e = world.exploration;
    world.sweep("10:20", 2);
    e.seekTick(0);
    EXPECT_THAT(readoutText(e, {}, 1), HasSubstr("T 8 to 12"));
}

TEST(Readout, SaysWhatIsAskedForAndNotThere) {
    tests::ScriptedExploration world;
    Exploration& e = world.exploration;
    e.seek(9);
    ASSERT_EQ(e.shown()->step, 5u) << "before the next frame nothing has come";
    EXPECT_THAT(readoutText(e, {}, 1), HasSubstr("\nrequested step 9, showing 5"));
}

TEST(Readout, SaysWhatPlaysAndWhatIsDrawnCoarsely) {
    tests::ScriptedExploration world;
    world.exploration.togglePlay();
    EXPECT_THAT(readoutText(world.exploration, {}, 0.85), HasSubstr("playing\nresolution 85 %"));
}

TEST(Readout, BeginsWithWhatIsAtTheHandsTip) {
    tests::ScriptedExploration world;
    TipProbe::At tip{1, {}, TipProbe::Value::Found};
    tip.reading.index = {3, 2, 1};
    tip.reading.position = {3, 2, 1};
    tip.reading.value = 21.5;
    EXPECT_THAT(readoutText(world.exploration, tip, 1),
                StartsWith("T 21.5\nx 3 m   [3]\nx 2 m   [2]\nx 1 m   [1]\nT "));
    tip.value = TipProbe::Value::None;
    EXPECT_THAT(readoutText(world.exploration, tip, 1), StartsWith("T: no value\n"));
    tip.value = TipProbe::Value::Sought;
    EXPECT_THAT(readoutText(world.exploration, tip, 1), StartsWith("T \u2026\n"));
}

TEST(Readout, BeforeThereAreDataSaysWhatIsComing) {
    Exploration empty({});
    EXPECT_EQ(readoutText(empty, {}, 1), "no file is open");
}

}  // namespace
}  // namespace app::headset
