#include "app/headset/readout.h"

#include <gmock/gmock.h>

#include "tests/support/scripted_exploration.h"

namespace app::headset {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Screen screenOf(const Exploration& e) {
    const Shown shown = *e.shown();
    return {shown.sorted, nullptr, shown.explorer, shown.dataset.variable, shown.step};
}

// Where the picture is what is shown.
std::string readout(const Exploration& e, const std::optional<TipProbe::At>& tip = {},
                    double scale = 1) {
    const Screen screen = screenOf(e);
    return readoutText(e, {&screen, *e.counts()}, tip, scale);
}

TEST(Readout, SaysWhatIsShown) {
    tests::ScriptedExploration world({.steps = 3, .times = {0, 0.5, 1}});
    Exploration& e = world.exploration;
    Explorer next = e.explorer();
    next.layers = {
        {.ranges = timeseries::RangeSet::parse("3:5"), .color = glm::dvec3(1), .opacity = 0.5}};
    e.edit(next);
    const std::string text = readout(e);
    // Values 0 to 63, each once.
    EXPECT_THAT(text, HasSubstr("T 3 to 5"));
    EXPECT_THAT(text, HasSubstr("step"));
    EXPECT_THAT(text, HasSubstr("\n3 points"));
    EXPECT_THAT(text, Not(HasSubstr("resolution")));
    EXPECT_THAT(text, Not(HasSubstr("playing")));
}

TEST(Readout, SaysTheErrorWhereItIsKnown) {
    tests::ScriptedExploration world;
    const Screen screen = screenOf(world.exploration);
    const auto told = [&](const char* error) {
        return readoutText(world.exploration, {&screen, *world.exploration.counts(), error}, {}, 1);
    };
    EXPECT_THAT(told("error about 3 %"), HasSubstr("points\nerror about 3 %"));
    EXPECT_THAT(told(""), Not(HasSubstr("error")));
}

// Once: the error says it, too, where it costs light.
TEST(Readout, SaysThatColoursAreMixed) {
    tests::ScriptedExploration world;
    const Screen screen = screenOf(world.exploration);
    const auto told = [&](const char* error, bool mixes) {
        return readoutText(world.exploration, {&screen, *world.exploration.counts(), error, mixes},
                           {}, 1);
    };
    EXPECT_THAT(told("", true), HasSubstr("points\ncolours mixed"));
    EXPECT_THAT(told("error about 3 %", true), HasSubstr("error about 3 %\ncolours mixed"));
    EXPECT_EQ(told("error about 3 %, light 8 % (colours mixed)", true),
              told("error about 3 %, light 8 % (colours mixed)", false));
    EXPECT_THAT(told("error about 3 %", false), Not(HasSubstr("mixed")));
}

TEST(Readout, FollowsTheSweptWindow) {
    tests::ScriptedExploration world;
    Exploration& e = world.exploration;
    world.sweep("10:20", 2);
    e.seekTick(0);
    EXPECT_THAT(readout(e), HasSubstr("T 8 to 12"));
}

TEST(Readout, IsOfThePictureUntilTheNextOneIsThere) {
    tests::ScriptedExploration world({.steps = 3});
    Exploration& e = world.exploration;
    EXPECT_EQ(readoutText(e, {}, {}, 1), "T \u2026");
    Explorer next = e.explorer();
    next.layers = {tests::layer("3:5")};
    e.edit(next);
    const Screen screen = screenOf(e);
    const PointCounts counts = *e.counts();
    const std::string before = readoutText(e, {&screen, counts}, {}, 1);
    next.layers = {tests::layer("7:9,20:30")};
    e.edit(next);
    EXPECT_EQ(readoutText(e, {&screen, counts}, {}, 1), before);
    EXPECT_NE(readout(e), before);
}

TEST(Readout, SaysWhatIsAskedForAndNotThere) {
    tests::ScriptedExploration world;
    Exploration& e = world.exploration;
    e.seek(9);
    ASSERT_EQ(e.shown()->step, 5u) << "before the next frame nothing has come";
    EXPECT_THAT(readout(e), HasSubstr("\nrequested step 9, showing 5"));
}

TEST(Readout, SaysWhatPlaysAndWhatIsDrawnCoarsely) {
    tests::ScriptedExploration world;
    world.exploration.togglePlay();
    EXPECT_THAT(readout(world.exploration, {}, 0.85), HasSubstr("playing\nresolution 85 %"));
}

TEST(Readout, BeginsWithWhatIsAtTheHandsTip) {
    tests::ScriptedExploration world;
    TipProbe::At tip{1, {}, TipProbe::Value::Found};
    tip.reading.index = {3, 2, 1};
    tip.reading.position = {3, 2, 1};
    tip.reading.value = 21.5;
    EXPECT_THAT(readout(world.exploration, tip),
                StartsWith("T 21.5\nx 3 m   [3]\nx 2 m   [2]\nx 1 m   [1]\nT "));
    tip.reading.cell = "3, wedge";
    EXPECT_THAT(readout(world.exploration, tip), HasSubstr("\nx 1 m   [1]\ncell 3, wedge\nT "));
    tip.value = TipProbe::Value::None;
    EXPECT_THAT(readout(world.exploration, tip), StartsWith("T: no value\n"));
    tip.value = TipProbe::Value::Sought;
    EXPECT_THAT(readout(world.exploration, tip), StartsWith("T \u2026\n"));
}

TEST(Readout, BeforeThereAreDataSaysWhatIsComing) {
    Exploration empty({});
    EXPECT_EQ(readoutText(empty, {}, {}, 1), "no file is open");
}

}  // namespace
}  // namespace app::headset
