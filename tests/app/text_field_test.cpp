#include <gtest/gtest.h>

#include "app/panels/widgets.h"

namespace app::panels {
namespace {

// One field in a window of ImGui without a renderer, and a mouse.
class ATextField : public testing::Test {
 protected:
    ATextField() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {400, 300};
        io.KeyMap[ImGuiKey_Escape] = kEscape;
        ImFont* font = io.Fonts->AddFontDefault();
        theme_ = {.scale = 1, .text = font, .strong = font, .small = font, .title = font};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        setFocus(focus_);
        frame();
    }
    ~ATextField() override { ImGui::DestroyContext(); }
    ATextField(const ATextField&) = delete;
    ATextField& operator=(const ATextField&) = delete;

    // What was entered in a frame, "abc" being refused; `told_`: something is drawn over all.
    std::optional<std::string> frame() {
        ImGui::NewFrame();
        focus_.begin({}, false);
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({400, 300});
        ImGui::Begin("window", nullptr, ImGuiWindowFlags_NoDecoration);
        auto entered = field_.draw(theme_, "##field", {{20, 20}, {220, 48}}, shown_);
        if (entered == "abc") field_.refuse("range 'abc' is not a number");
        told_ = ImGui::GetForegroundDrawList()->VtxBuffer.Size > 0;
        ImGui::End();
        focus_.end(1);
        ImGui::EndFrame();
        return entered;
    }
    std::optional<std::string> click(ImVec2 at) {
        std::optional<std::string> entered;
        ImGui::GetIO().MousePos = at;
        for (const bool down : {false, true, false, false}) {
            ImGui::GetIO().MouseDown[0] = down;
            if (auto text = frame()) entered = text;
        }
        return entered;
    }
    // Clicks it, types in place of what it holds, and clicks elsewhere.
    std::optional<std::string> enter(const char* text) {
        click({60, 34});
        for (const char* c = text; *c != '\0'; ++c)
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(*c));
        frame();
        return click({300, 200});
    }

    static constexpr int kEscape = 1;
    Theme theme_;
    Focus focus_;
    TextField field_;
    std::string shown_ = "600:1000";
    bool told_ = false;
};

TEST_F(ATextField, GivesWhatWasEntered) {
    EXPECT_EQ(enter(""), std::nullopt);
    EXPECT_EQ(enter("5:6"), "5:6");
    EXPECT_FALSE(told_);
}

// Beyond 16 bits, and Latin-1.
TEST_F(ATextField, KeepsTheCharactersThatImGuiHasNot) {
    shown_ = "😀 caf\xE9";
    EXPECT_EQ(enter(""), std::nullopt) << "it is as shown";
}

TEST_F(ATextField, KeepsWhatItRefusedAndSaysWhyUntilItIsChanged) {
    ASSERT_EQ(enter("abc"), "abc");
    EXPECT_TRUE(told_);
    EXPECT_EQ(enter(""), "abc") << "the text is still there";
    EXPECT_EQ(enter("5:6"), "5:6");
    EXPECT_FALSE(told_);
}

TEST_F(ATextField, ForgetsWhatItRefusedWhereAnotherTextIsToBeShown) {
    ASSERT_EQ(enter("abc"), "abc");
    shown_ = "1:2";  // undone, or dragged
    frame();
    EXPECT_FALSE(told_);
    EXPECT_EQ(enter(""), std::nullopt) << "it is as shown";
}

TEST_F(ATextField, GivesUpWhatItRefusedAtEscapeAlsoWhereItIsLeft) {
    for (const bool isLeft : {false, true}) {
        ASSERT_EQ(enter("abc"), "abc");
        if (!isLeft) click({60, 34});
        ImGui::GetIO().KeysDown[kEscape] = true;
        frame();
        ImGui::GetIO().KeysDown[kEscape] = false;
        frame();
        EXPECT_FALSE(told_);
        EXPECT_EQ(enter(""), std::nullopt) << "it is as shown";
    }
}

}  // namespace
}  // namespace app::panels
