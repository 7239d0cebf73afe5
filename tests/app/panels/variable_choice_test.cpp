// The variable chooser of the header.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/panels/focus.h"
#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

bool isOpen() { return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup); }

void openChooser(tests::PanelsDesk& desk) {
    const Rect header = sideLayout(desk.layout(), 1).header;
    desk.click(header.min + glm::vec2(kMargin + 40, 63));
    desk.frames(2);
}

TEST(VariableChoice, OpensOnAFileOfOneVariable) {
    tests::PanelsDesk desk(tests::World{.variables = {"T"}});
    openChooser(desk);
    EXPECT_TRUE(isOpen());
    desk.press(Key::Escape);
    EXPECT_FALSE(isOpen());
    EXPECT_FALSE(desk.exploration.canUndo());
}

TEST(VariableChoice, ChoosesAnother) {
    tests::PanelsDesk desk(tests::World{.variables = {"T", "P"}});
    openChooser(desk);
    ASSERT_EQ(focus().controls().size(), 2u);
    desk.click(focus().controls()[1].at.centre());
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer().variable, "P");
    EXPECT_FALSE(isOpen());
}

// The one that is shown stands lit: keys go on from there.
TEST(VariableChoice, BeginsAtTheOneThatIsShown) {
    for (const bool byKeys : {false, true}) {
        tests::PanelsDesk desk(tests::World{.variables = {"T", "P", "U", "V"}});
        desk.choose("P");
        desk.untilOpened();
        desk.frames(2);
        if (byKeys) {
            for (int i = 0; i < 9 && !isOpen(); ++i) {
                desk.press(Key::Tab);
                const auto at =
                    std::ranges::find(focus().controls(), focus().place(), &Focus::Control::id);
                if (at->at.holds(sideLayout(desk.layout(), 1).header.min +
                                 glm::vec2(kMargin + 40, 63)))
                    desk.press(Key::Enter);
            }
            desk.frames(2);
        } else {
            openChooser(desk);
        }
        ASSERT_EQ(focus().controls().size(), 4u);
        desk.press(Key::Down);
        EXPECT_EQ(focus().holder(), focus().controls()[2].id);
        desk.press(Key::Enter);
        desk.untilOpened();
        EXPECT_EQ(desk.exploration.explorer().variable, "U");
    }
}

}  // namespace
}  // namespace app::panels
