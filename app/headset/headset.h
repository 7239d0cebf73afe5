// A headset as a front end: the runtime's frames, the room, the exploration, both eyes.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <variant>
#include <vector>

#include "app/desktop/file_actions.h"
#include "app/desktop/stop_signals.h"
#include "app/desktop/x_errors.h"
#include "app/exploration/exploration.h"
#include "app/headset/eyes.h"
#include "app/headset/graphics.h"
#include "app/headset/hand_interaction.h"
#include "app/headset/panel.h"
#include "app/headset/seen_error.h"
#include "app/headset/text_board.h"
#include "xr/session.h"

namespace app::headset {

class Headset {
 public:
    // Both must outlive it; `exporting` as FileActions has it. Throws std::runtime_error when there
    // is no GL to draw with.
    static std::variant<std::unique_ptr<Headset>, xr::NoHeadset> open(
        Exploration& exploration, std::optional<ExportJob>& exporting);

    // Until the user or the runtime ends the session, or a signal the program. Throws
    // xr::LostError; the exploration is then as it was in the last frame, and kept as that.
    void run();
    // One round of it, which the runtime paces; false when the session has ended.
    bool frame();

    const HandInteraction& interaction() const { return interaction_; }
    const Panel& panel() const { return panel_; }
    const Eyes& eyes() const { return eyes_; }
    // When what was drawn last is seen, and the display's period; for who measures.
    struct Timing {
        std::chrono::nanoseconds displayTime{0}, period{0};
        bool drawn = false;
    };
    const Timing& timing() const { return timing_; }

 private:
    using Clock = std::chrono::steady_clock;

    Headset(Exploration& exploration, std::optional<ExportJob>& exporting,
            std::unique_ptr<Graphics> graphics, std::unique_ptr<xr::Session> session);
    void attendWindow();
    std::chrono::nanoseconds since(std::chrono::nanoseconds displayTime);
    void act(const xr::Session::Frame& frame, std::chrono::nanoseconds dt);
    void drawBoards(const xr::Session::Frame& frame, std::chrono::nanoseconds dt);
    Rung drawn() const;
    const panels::Performance& performance(const xr::Session::Frame& frame);
    std::vector<render::Placard> placards(const xr::Session::Frame& frame) const;
    void drawEyes(xr::Session::Frame& frame, Clock::time_point began);

    std::atomic<bool> stopped_ = false;
    Exploration& exploration_;
    std::unique_ptr<Graphics> graphics_;
    std::unique_ptr<xr::Session> session_;
    HandInteraction interaction_;
    std::optional<HandCommand> asked_;  // by the panel, for the next frame
    Eyes eyes_;
    Panel panel_;
    TextBoard readout_;
    SeenError error_;
    Parts parts_ = Parts::None;  // whether the panel shows what it comes from
    desktop::FileActions fileActions_;
    std::optional<std::chrono::nanoseconds> lastDisplay_;
    panels::Performance performance_;
    std::chrono::nanoseconds performanceOf_{0};  // when it was taken, as display time
    Timing timing_;
    bool leaving_ = false;  // the window is closed, and the runtime was told
    desktop::AtConnectionsEnd atConnectionsEnd_{[this] { fileActions_.rescue(); }};
    desktop::StopSignals signals_;  // last: its thread uses what stands above
};

}  // namespace app::headset
