// What a headset's frames may hold so that they come in time with its display: splats, then pixels,
// then the display's rate. Pure: a function of recorded frame times.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "app/drawing/governor.h"
#include "xr/refresh_rate.h"
#include "xr/render_scale.h"

namespace app::headset {

class DisplayPace {
 public:
    // Of the display's period, what a frame's work is to fill: the rest is for the runtime, and for
    // frames that are slower than those before.
    static constexpr double kShare = 0.7;

    // `refreshRates`: those that the display offers.
    explicit DisplayPace(std::vector<double> refreshRates = {}) : rate_(std::move(refreshRates)) {}

    struct FrameCost {
        std::chrono::nanoseconds period;  // the display's own (xr::DisplayPeriod)
        std::chrono::nanoseconds work;    // all that was done for it, not what was waited
        // What was learnt of what splats cost: of this frame, or of one before.
        struct Splats {
            std::uint64_t count, fewest;  // drawn; with the coarsest subset
            std::chrono::nanoseconds took;
            bool areCells = false;  // for which points may stand
            double finer = 2;       // as Governor::Drawn has it
        };
        std::optional<Splats> splats;
    };
    void took(const FrameCost& frame);

    Governor& governor() { return governor_; }
    const Governor& governor() const { return governor_; }
    // Of the recommended resolution. Lowered where not even the fewest splats fit, and climbs back
    // where they would.
    double scale() const { return scale_.scale(); }
    const xr::RefreshRate& refreshRate() const { return rate_; }

 private:
    Governor governor_{Governor::Rise::Proven};
    xr::RenderScale scale_;
    xr::RefreshRate rate_;
};

}  // namespace app::headset
