// The window's panels on a board: Dear ImGui drawn into a texture, with a ray for a mouse.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "app/headset/hand_buttons.h"
#include "app/panels/interface.h"
#include "render/annotate/placard.h"

struct ImDrawData;

namespace app::headset {

inline constexpr float kPanelScale = 1.3f;  // pixels a unit of the panels' design

// The only user of Dear ImGui while it lives. Needs a current GL context, from construction to
// destruction.
class Panel {
 public:
    // `wake`: as Exploration::Settings.
    explicit Panel(std::function<void()> wake);
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;

    // What the front end tells the panels, beside where the pointer is.
    struct Around {
        panels::StartOffers offers;
        std::string help;  // stands where a window has its picture
        std::optional<std::string> exporting;
        panels::Performance performance;
        HandButtons buttons;
    };
    // What it asks of the front end, and of the hands' interaction.
    struct Asked {
        panels::Requests requests;
        std::optional<HandCommand> interaction;
    };
    // A frame of the interface; its picture is drawn only when it is another than before.
    Asked draw(Exploration& exploration, const std::optional<Pointer>& pointer,
               const Around& around, std::chrono::nanoseconds dt);

    const render::Board& board() const { return board_; }
    std::uint64_t timesDrawn() const { return timesDrawn_; }
    panels::Interface& interface() { return interface_; }
    const panels::Interface& interface() const { return interface_; }

 private:
    struct Context {
        Context();
        ~Context();
        panels::Theme theme;
    };

    // Whether the board shows something else than these.
    bool isNew(const ImDrawData& drawing);

    Context context_;
    render::Board board_;
    std::vector<std::byte> onBoard_, drawing_;  // what Dear ImGui draws there; room for the next
    std::uint64_t timesDrawn_ = 0;
    panels::Interface interface_;
};

}  // namespace app::headset
