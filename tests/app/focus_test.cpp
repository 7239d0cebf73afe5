#include "app/panels/focus.h"

#include <gtest/gtest.h>

#include <vector>

namespace app::panels {
namespace {

// Controls in a grid of 3 columns and rows, 40 wide and 20 high, in a window of ImGui without a
// renderer.
class AFocus : public testing::Test {
 protected:
    AFocus() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {400, 300};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        frame();
    }
    ~AFocus() override { ImGui::DestroyContext(); }
    AFocus(const AFocus&) = delete;
    AFocus& operator=(const AFocus&) = delete;

    // A frame in which a key came; which control then has the focus (0: none).
    ImGuiID frame(std::optional<KeyPress> key = {}) {
        ImGui::NewFrame();
        taken_ = focus_.begin(key, false);
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({400, 300});
        ImGui::Begin("window", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGuiID with = 0;
        const auto draw = [&](ImGuiID id, glm::vec2 at) {
            const auto turn = focus_.control(
                id, {at, at + glm::vec2(40, 20)},
                id == slider_ ? Focus::Takes::LeftRight : Focus::Takes::Nothing, id != noStop_);
            if (!turn.has) return;
            with = id;
            turn_ = turn;
        };
        turn_ = {};
        for (ImGuiID id = 1; id <= 9; ++id)
            if (id != gone_)
                draw(id, {50.0f * static_cast<float>((id - 1) % 3),
                          30.0f * static_cast<float>((id - 1) / 3)});
        if (popup_) {
            focus_.enterFront();
            draw(21, {200, 100});
            draw(22, {200, 130});
            focus_.leaveFront();
        }
        ImGui::End();
        focus_.end(1);
        ImGui::EndFrame();
        return with;
    }
    ImGuiID press(Key key, bool shift = false) {
        return frame(KeyPress{.key = key, .shift = shift});
    }

    Focus focus_;
    Focus::Turn turn_;
    bool taken_ = false, popup_ = false;
    ImGuiID slider_ = 0, noStop_ = 0, gone_ = 0;
};

TEST_F(AFocus, TakesNoKeysBeforeTab) {
    for (const Key key : {Key::Space, Key::Left, Key::Up, Key::Home, Key::Enter, Key::Escape}) {
        EXPECT_EQ(press(key), 0u);
        EXPECT_FALSE(taken_);
    }
}

TEST_F(AFocus, GoesRoundWithTabBothWays) {
    for (const ImGuiID id : {1, 2, 3, 4, 5, 6, 7, 8, 9, 1}) EXPECT_EQ(press(Key::Tab), id);
    for (const ImGuiID id : {9, 8, 7}) EXPECT_EQ(press(Key::Tab, true), id);
}

TEST_F(AFocus, GoesWhereArrowsPoint) {
    press(Key::Tab);
    EXPECT_EQ(press(Key::Right), 2u);
    EXPECT_EQ(press(Key::Down), 5u);
    EXPECT_EQ(press(Key::Down), 8u);
    EXPECT_EQ(press(Key::Down), 8u) << "nothing lies there";
    EXPECT_EQ(press(Key::Left), 7u);
    EXPECT_EQ(press(Key::Up), 4u);
}

TEST_F(AFocus, GivesArrowsToTheControlThatTakesThem) {
    slider_ = 2;
    press(Key::Tab);
    press(Key::Tab);
    EXPECT_EQ(press(Key::Right), 2u);
    EXPECT_EQ(turn_.by, 1);
    EXPECT_EQ(press(Key::Left, true), 2u);
    EXPECT_EQ(turn_.by, -10);
    EXPECT_EQ(press(Key::Home), 2u);
    EXPECT_EQ(turn_.toEnd, -1);
    EXPECT_EQ(press(Key::Down), 5u);
}

TEST_F(AFocus, EntersWithEnterAndSpace) {
    press(Key::Tab);
    for (const Key key : {Key::Enter, Key::KeypadEnter, Key::Space}) {
        press(key);
        EXPECT_TRUE(turn_.entered && taken_);
        frame();
        EXPECT_FALSE(turn_.entered);
    }
}

TEST_F(AFocus, GivesKeysBackWithEscapeAndGoesOnFromThere) {
    press(Key::Tab);
    press(Key::Tab);
    EXPECT_EQ(press(Key::Escape), 0u);
    EXPECT_TRUE(taken_);
    press(Key::Space);
    EXPECT_FALSE(taken_);
    EXPECT_EQ(press(Key::Tab), 3u);
}

TEST_F(AFocus, LeavesLettersAndCommandsAlone) {
    press(Key::Tab);
    press(key('F'));
    EXPECT_FALSE(taken_);
    frame(KeyPress{.key = Key::Space, .ctrl = true});
    EXPECT_FALSE(taken_);
}

TEST_F(AFocus, PassesOverWhatIsNoStopButArrowsReachIt) {
    noStop_ = 2;
    press(Key::Tab);
    EXPECT_EQ(press(Key::Tab), 3u);
    EXPECT_EQ(press(Key::Left), 2u);
    EXPECT_EQ(press(Key::Tab), 3u);
}

TEST_F(AFocus, StaysInFrontWhileAPopupIsOpenAndComesBack) {
    for (int i = 0; i < 5; ++i) press(Key::Tab);
    popup_ = true;
    frame();
    EXPECT_EQ(frame(), 21u);
    EXPECT_EQ(press(Key::Tab), 22u);
    EXPECT_EQ(press(Key::Tab), 21u);
    EXPECT_EQ(press(Key::Up), 21u) << "what lies behind is not reached";
    press(Key::Escape);
    EXPECT_FALSE(taken_) << "the popup's own";
    popup_ = false;
    frame();
    EXPECT_EQ(frame(), 5u);
}

TEST_F(AFocus, IsNobodysAgainBehindAPopupThatWasOpenedWithoutIt) {
    popup_ = true;
    EXPECT_EQ(frame(), 0u);
    EXPECT_EQ(press(Key::Down), 21u) << "an arrow is enough";
    popup_ = false;
    frame();
    EXPECT_EQ(frame(), 0u);
    press(Key::Space);
    EXPECT_FALSE(taken_);
}

TEST_F(AFocus, IsNobodysAgainWhereAPopupWasLeftWithTheMouse) {
    press(Key::Tab);
    popup_ = true;
    frame();
    ImGui::GetIO().MouseDown[0] = true;
    frame();
    ImGui::GetIO().MouseDown[0] = false;
    popup_ = false;
    frame();
    EXPECT_EQ(frame(), 0u);
    press(Key::Space);
    EXPECT_FALSE(taken_) << "the picture's";
}

TEST_F(AFocus, GoesToTheNearestWhenItsControlIsGone) {
    for (int i = 0; i < 5; ++i) press(Key::Tab);
    gone_ = 5;
    frame();
    const ImGuiID now = frame();
    EXPECT_TRUE(now == 2 || now == 4 || now == 6 || now == 8) << now;
}

}  // namespace
}  // namespace app::panels
