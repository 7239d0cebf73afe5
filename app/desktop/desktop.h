// The window's loop: events, the exploration, the picture, the interface over it. Sleeps while
// nothing moves.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <optional>
#include <variant>

#include "app/desktop/file_actions.h"
#include "app/desktop/gui.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/stop_signals.h"
#include "app/desktop/window.h"
#include "app/desktop/x_errors.h"
#include "app/exploration/exploration.h"
#include "app/panels/interface.h"
#include "xr/session.h"

namespace app::desktop {

class Desktop {
 public:
    // Both must outlive this; `exporting` as FileActions has it, Settings::wake is Window::wake.
    // Throws std::runtime_error when there is no window to be had.
    Desktop(Exploration& exploration, std::optional<ExportJob>& exporting);
    // Until the window is closed or a signal ends it; or until a headset is asked for that answers.
    enum class End { Closed, ToHeadset };
    End run();

 private:
    using Clock = std::chrono::steady_clock;

    void frame(std::chrono::nanoseconds dt);
    void interact(std::chrono::nanoseconds dt);
    void serve(const panels::Requests& requests);
    panels::Layout layout();
    bool drawPicture();  // whether it is another
    void title();
    void sleep();
    void askForHeadset();
    bool headsetAnswers();

    std::atomic<bool> stopped_ = false;
    Window window_;
    Gui gui_;
    Exploration& exploration_;
    panels::Interface interface_;
    PictureView picture_;
    FileActions fileActions_;
    Clock::time_point last_ = Clock::now();
    // Frames until the loop may sleep: the interface shows what the exploration was a frame ago.
    int restless_ = 2;
    bool drew_ = true;  // in the last frame: one that looks like the one before is not drawn
    // While a runtime is asked: it may take its time.
    std::future<std::variant<xr::Session::Offer, xr::NoHeadset>> asked_;
    AtConnectionsEnd atConnectionsEnd_{[this] { fileActions_.rescue(); }};
    StopSignals signals_;  // last: its thread uses what stands above
};

}  // namespace app::desktop
