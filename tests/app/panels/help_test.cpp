// The card of all keys.
#include "app/panels/help.h"

#include <gtest/gtest.h>

#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

struct HelpDesk : tests::PanelsDesk {
    explicit HelpDesk(glm::vec2 window) : PanelsDesk(tests::World{}, window) {
        interface.obey(exploration, Command::Help);
        frames(3);
        const Rect picture = layout().picture;
        card = helpLayout(picture, 1, helpLines().size(), 6);  // at least: lines may be broken
        moveTo(card.whole.centre());
    }
    // Where the first letter of the card is drawn: the highest corner in the accent's colour.
    float first() {
        frames(2);
        ImGui::Render();
        const ImDrawData& drawn = *ImGui::GetDrawData();
        float y = 1e9f;
        for (int list = 0; list < drawn.CmdListsCount; ++list)
            for (const ImDrawVert& corner : drawn.CmdLists[list]->VtxBuffer)
                if (corner.col == kAccent && card.whole.holds(vec(corner.pos)))
                    y = std::min(y, corner.pos.y);
        return y;
    }
    void roll(float by) {
        ImGui::GetIO().MouseWheel = by;
        frame();
        ImGui::GetIO().MouseWheel = 0;
    }

    HelpLayout card;
};

TEST(Help, ScrollsWhereItIsHigherThanThePicture) {
    HelpDesk desk({800, 640});
    ASSERT_GT(desk.card.height, desk.card.whole.size().y + 50);
    const ViewChoice view = desk.exploration.explorer().view;
    const float top = desk.first();
    desk.roll(-1);
    EXPECT_NE(desk.first(), top);
    desk.roll(10);
    EXPECT_EQ(desk.first(), top) << "no farther than its beginning";
    EXPECT_TRUE(desk.exploration.explorer().view == view) << "the picture behind it stays";
    desk.press(Key::Down);
    EXPECT_NE(desk.first(), top);
    desk.press(Key::Up);
    EXPECT_EQ(desk.first(), top);
}

TEST(Help, IsWholeWhereItHasRoom) {
    HelpDesk desk({1440, 1000});
    const float top = desk.first();
    desk.roll(-1);
    desk.press(Key::Down);
    EXPECT_EQ(desk.first(), top);
}

}  // namespace
}  // namespace app::panels
