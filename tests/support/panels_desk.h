// The panels without a window: ImGui that nobody renders, with a mouse and keys of the test's.
#pragma once

#include <imgui.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "app/panels/interface.h"
#include "tests/support/exploration_desk.h"

namespace tests {

class PanelsDesk : public ExplorationDesk {
 public:
    // With a world that is shown, or with nothing.
    explicit PanelsDesk(const std::optional<World>& made = World{}, glm::vec2 window = {1280, 900})
        : ExplorationDesk({{"world", made.value_or(World{})}}), window_(window) {
        if (made) open("world");
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.MousePos = {-1, -1};
        // As the window has it, but Tab and arrows too go to the panels alone.
        using app::panels::Key;
        for (const auto& [own, key] : {std::pair<int, Key>{ImGuiKey_Enter, Key::Enter},
                                       {ImGuiKey_Escape, Key::Escape},
                                       {ImGuiKey_Space, Key::Space}})
            io.KeyMap[own] = static_cast<int>(key);
        theme_ = app::panels::makeTheme(1);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
        frames(2);
    }
    ~PanelsDesk() { ImGui::DestroyContext(); }
    PanelsDesk(const PanelsDesk&) = delete;
    PanelsDesk& operator=(const PanelsDesk&) = delete;

    // A frame of a hundredth of a second; what it asks for is done, or kept in `asked`.
    void frame(const std::optional<app::panels::KeyPress>& key = {}) {
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {window_.x, window_.y};
        io.DeltaTime = 0.01f;
        exploration.advance(kFrame);
        asked = {};
        ImGui::NewFrame();
        interface.draw(exploration,
                       {.window = window_,
                        .theme = theme_,
                        .offers = offers,
                        .eye = {},
                        .hasPicture = !inHeadset,
                        .exporting = exporting,
                        .dt = kFrame,
                        .key = key,
                        .performance = performance},
                       asked);
        ImGui::EndFrame();
        for (const app::panels::Command command : asked.commands)
            interface.obey(exploration, command);
    }
    void frames(int n) {
        while (n-- > 0) frame();
    }

    void press(app::panels::Key key, bool shift = false) {
        bool& down = ImGui::GetIO().KeysDown[static_cast<int>(key)];
        down = true;
        frame(app::panels::KeyPress{.key = key, .shift = shift});
        down = false;
        frame();
    }
    void type(std::string_view text) {
        for (const char c : text) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
            frame(app::panels::KeyPress{.key = app::panels::key(c)});
        }
    }
    void moveTo(glm::vec2 at) {
        ImGui::GetIO().MousePos = {at.x, at.y};
        frame();
    }
    void hold(bool down) {
        ImGui::GetIO().MouseDown[0] = down;
        frame();
    }
    // Each of them in a frame of its own, as events come.
    void click(glm::vec2 at) {
        moveTo(at);
        hold(true);
        hold(false);
        frame();
    }

    const app::panels::Theme& theme() const { return theme_; }
    app::panels::Layout layout() { return app::panels::layoutOf(window_, 1); }

    app::panels::Interface interface {
        [script = script] { script->wake(); }
    };
    app::panels::StartOffers offers;
    std::optional<std::string> exporting;
    app::panels::Performance performance{.report = {.whole = true}};
    app::panels::Requests asked;  // of the last frame
    bool inHeadset = false;       // the panel that stands there

 private:
    static constexpr std::chrono::milliseconds kFrame{10};
    glm::vec2 window_;
    app::panels::Theme theme_;
};

}  // namespace tests
