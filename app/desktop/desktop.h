// The window's loop: events, the exploration, the picture, the interface over it. Sleeps while
// nothing moves.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>

#include "app/canvas.h"
#include "app/desktop/errands.h"
#include "app/desktop/gui.h"
#include "app/desktop/stop_signals.h"
#include "app/desktop/window.h"
#include "app/exploration.h"
#include "app/options.h"
#include "app/panels/interface.h"
#include "render/frame_pace.h"
#include "render/kept_picture.h"
#include "render/present.h"

namespace app::desktop {

class Desktop {
 public:
    // Throws std::runtime_error when there is no window to be had.
    explicit Desktop(const ViewOptions& options);
    // Until the window is closed or a signal ends it.
    void run();

 private:
    using Clock = std::chrono::steady_clock;

    void interact(std::chrono::nanoseconds dt);
    void serve(panels::Requests& requests);
    std::optional<panels::Reading> read(glm::vec2 at) const;
    void fitPicture();
    void drawPicture();
    void title();
    void sleep();
    bool pictureIsCurrent(const Shown& shown) const;

    std::atomic<bool> stopped_ = false;
    Window window_;
    Gui gui_;
    Exploration exploration_;
    panels::Interface interface_;
    Canvas canvas_;
    Errands errands_;
    render::Present present_;
    render::FramePace pace_;
    std::optional<render::KeptPicture> kept_;

    // What the kept picture shows.
    struct Drawn {
        Explorer explorer;
        std::shared_ptr<const timeseries::SortedStep> sorted;
    };
    std::optional<Drawn> drawn_;
    CanvasReport report_;
    panels::Performance performance_;
    glm::dvec3 boxHalf_{0.5};
    std::optional<render::View> eye_;
    Clock::time_point last_ = Clock::now(), changed_ = last_;
    // Frames until the loop may sleep: the interface shows what the exploration was a frame ago.
    int restless_ = 3;
    StopSignals signals_;  // last: its thread uses what stands above
};

}  // namespace app::desktop
