// What keys mean where something takes text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "app/panels/focus.h"
#include "tests/support/files.h"
#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

// All that is a command by itself, where nothing takes it.
constexpr std::string_view kCommands = "FHPVIOL1234567,. ";

std::size_t commandsOf(tests::PanelsDesk& desk, std::string_view typed) {
    std::size_t asked = 0;
    for (const char c : typed) {
        ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
        desk.frame(KeyPress{.key = key(c)});
        asked += desk.asked.commands.size();
    }
    return asked;
}

TEST(Keys, AreThePicturesWhereNothingTakesThem) {
    tests::PanelsDesk desk;
    EXPECT_GT(commandsOf(desk, kCommands), 5u);
}

// From the very frame after it was pressed, and until it is left.
TEST(Keys, NeverReachThePictureFromAField) {
    tests::PanelsDesk desk;
    desk.sweep("0:64", 2);
    desk.frames(3);
    std::vector<Focus::Control> fields;
    for (const Focus::Control& c : focus().controls())
        if (c.takes == Focus::Takes::Typing && c.clip.holds(c.at.centre())) fields.push_back(c);
    ASSERT_GT(fields.size(), 4u);
    for (const Focus::Control& field : fields) {
        SCOPED_TRACE(fmt::format("the field at {}, {}", field.at.min.x, field.at.min.y));
        desk.moveTo(field.at.centre());
        desk.hold(true);
        ASSERT_TRUE(ImGui::IsAnyItemActive());
        EXPECT_EQ(commandsOf(desk, kCommands), 0u);
        desk.hold(false);
        EXPECT_EQ(commandsOf(desk, kCommands), 0u);
        desk.press(Key::Escape);
        EXPECT_FALSE(ImGui::IsAnyItemActive());
    }
    EXPECT_TRUE(desk.exploration.messages().empty());
}

// What is typed next goes into it, in place of what it refused.
TEST(Keys, GoToAFieldOnAfterItRefusedWhatWasEntered) {
    tests::PanelsDesk desk;
    Explorer e = desk.exploration.explorer();
    e.layers = {tests::layer("4:20")};
    desk.exploration.edit(e);
    desk.frames(2);
    const SideLayout side = sideLayout(desk.layout(), 1);
    desk.click(layerRow(side.layers, side.layers.min.y + kLayersTitle, 1).text.centre());
    desk.type("abc");
    desk.press(Key::Enter);
    EXPECT_EQ(commandsOf(desk, kCommands), 0u);
    EXPECT_TRUE(ImGui::IsAnyItemActive());
    desk.press(Key::Enter);
    desk.frames(3);
    desk.type("25:30");
    desk.press(Key::Enter);
    EXPECT_EQ(desk.exploration.explorer().layers.at(0).ranges,
              timeseries::RangeSet::parse("25:30"));
    EXPECT_FALSE(ImGui::IsAnyItemActive());
    EXPECT_EQ(desk.exploration.explorer().view, e.view);
    EXPECT_GT(commandsOf(desk, kCommands), 5u) << "the picture's again";
}

// Who leaves it with a click wants something else.
TEST(Keys, AreNotKeptByAFieldThatIsLeftWithWhatItRefuses) {
    tests::PanelsDesk desk;
    desk.frames(2);
    const SideLayout side = sideLayout(desk.layout(), 1);
    desk.click(layerRow(side.layers, side.layers.min.y + kLayersTitle, 1).text.centre());
    desk.type("abc");
    desk.click(desk.layout().picture.centre());
    desk.frames(3);
    EXPECT_FALSE(ImGui::IsAnyItemActive());
    EXPECT_GT(commandsOf(desk, kCommands), 5u);
}

TEST(Keys, NeverReachThePictureWhileFilesOrAPopupStandBeforeIt) {
    std::filesystem::current_path(tests::freshFolder());
    tests::PanelsDesk desk;
    desk.interface.obey(desk.exploration, Command::Save);
    desk.frames(3);
    desk.click({20, 20});  // beside it: no field has the text
    EXPECT_EQ(commandsOf(desk, kCommands), 0u);
    desk.press(Key::Escape);
    desk.frames(2);
    EXPECT_GT(commandsOf(desk, kCommands), 5u);
}

// As Enter does: what is typed is of the session that is saved, and nothing typed later lands in
// the field.
TEST(Keys, OfFilesTakeWhatIsTyped) {
    for (const KeyPress& press :
         {KeyPress{.key = key('S'), .ctrl = true}, KeyPress{.key = key('E'), .ctrl = true},
          KeyPress{.key = Key::F12}}) {
        std::filesystem::current_path(tests::freshFolder());
        tests::PanelsDesk desk;
        const Rect layers = sideLayout(desk.layout(), 1).layers;
        const auto& controls = focus().controls();
        const auto field = std::ranges::find_if(controls, [&](const Focus::Control& c) {
            return c.takes == Focus::Takes::Typing && layers.holds(c.at.centre());
        });
        ASSERT_NE(field, controls.end());
        desk.click(field->at.centre());
        desk.type("5:9");
        EXPECT_NE(desk.exploration.explorer().layers[0].ranges, timeseries::RangeSet::parse("5:9"));
        desk.frame(press);
        EXPECT_EQ(desk.exploration.explorer().layers[0].ranges, timeseries::RangeSet::parse("5:9"));
        EXPECT_EQ(desk.asked.commands.size(), 1u);
        desk.type("zzz");
        EXPECT_EQ(desk.exploration.explorer().layers[0].ranges, timeseries::RangeSet::parse("5:9"));
        EXPECT_TRUE(desk.exploration.messages().empty());
    }
}

}  // namespace
}  // namespace app::panels
