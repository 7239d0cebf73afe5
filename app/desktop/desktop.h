// The window's loop: events, the exploration, the picture, the interface over it. Sleeps while
// nothing moves.
#pragma once

#include <atomic>
#include <chrono>

#include "app/desktop/errands.h"
#include "app/desktop/gui.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/stop_signals.h"
#include "app/desktop/window.h"
#include "app/exploration.h"
#include "app/panels/interface.h"

namespace app::desktop {

class Desktop {
 public:
    // `exploration` must outlive this; its Settings::wake is Window::wake. Throws
    // std::runtime_error when there is no window to be had.
    explicit Desktop(Exploration& exploration);
    // Until the window is closed or a signal ends it.
    void run();

 private:
    using Clock = std::chrono::steady_clock;

    void frame(std::chrono::nanoseconds dt);
    void interact(std::chrono::nanoseconds dt);
    void serve(panels::Requests& requests);
    void drawPicture();
    void title();
    void sleep();

    std::atomic<bool> stopped_ = false;
    Window window_;
    Gui gui_;
    Exploration& exploration_;
    panels::Interface interface_;
    PictureView picture_;
    Errands errands_;
    Clock::time_point last_ = Clock::now();
    // Frames until the loop may sleep: the interface shows what the exploration was a frame ago.
    int restless_ = 2;
    StopSignals signals_;  // last: its thread uses what stands above
};

}  // namespace app::desktop
