// Dear ImGui in a window: its context, its renderer, and events handed to it so that each is seen.
// A frame of ImGui knows only the last state of a button; a press and a release that come during
// one slow frame would be lost. So a frame takes only events that do not hide each other.
#pragma once

#include <imgui.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/desktop/window.h"
#include "app/panels/keys.h"
#include "app/panels/theme.h"

namespace app::desktop {

// What a frame brought for others than ImGui.
struct FrameInput {
    std::optional<panels::KeyPress> key;
    std::vector<std::filesystem::path> dropped;
};

class Gui {
 public:
    // REQUIRES: the window's context is current, from construction to destruction.
    Gui(Window& window, float scale);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    const panels::Theme& theme() const { return theme_; }
    void setScale(float scale);  // between frames

    // Takes what it can of the window's events and begins a frame.
    FrameInput beginFrame(std::chrono::nanoseconds dt);
    void endFrame();  // one that is not drawn
    // Ends a frame that may be drawn; whether it looks otherwise than the one before that did.
    bool finishFrame();
    void draw() const;  // what was finished, over what stands in the window

 private:
    const char* pasted();  // as ImGui asks for the clipboard; null: there is no text

    Window& window_;
    panels::Theme theme_;
    std::string pasted_;
    std::uint64_t looks_ = 0;  // of the frame that was finished last
};

}  // namespace app::desktop
