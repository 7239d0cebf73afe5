// What a headset's frames may hold so that they come in time: splats, then pixels, then the
// display's rate. Pure: a function of recorded frame times.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "render/frame/frame_pace.h"
#include "xr/refresh_rate.h"
#include "xr/render_scale.h"

namespace app::headset {

class Governor {
 public:
    // Of the display's period, what a frame's work is to fill: the rest is for the runtime, and for
    // frames that are slower than those before.
    static constexpr double kShare = 0.7;

    // `refreshRates`: those that the display offers.
    explicit Governor(std::vector<double> refreshRates = {}) : rate_(std::move(refreshRates)) {}

    struct FrameCost {
        std::chrono::nanoseconds period;  // the display's own (xr::DisplayPeriod)
        std::chrono::nanoseconds work;    // all that was done for it, not what was waited
        // What was learnt of what splats cost: of this frame, or of one before.
        struct Splats {
            std::uint64_t count, fewest;  // drawn; with the coarsest subset
            std::chrono::nanoseconds took;
            bool areCells = false;  // for which points may stand
        };
        std::optional<Splats> splats;
    };
    void took(const FrameCost& frame);

    // The most for the next frame, all eyes together. Fewer at once; more where a while has shown
    // that they fit, and a longer one where that was wrong before.
    std::uint64_t splats() const { return splats_; }
    // The most cells for the next frame; their cost is learnt apart.
    std::uint64_t cells() const { return cells_.budget(); }
    // Of the recommended resolution. Lowered where not even the fewest splats fit, and climbs back
    // where they would.
    double scale() const { return scale_.scale(); }
    const xr::RefreshRate& refreshRate() const { return rate_; }

 private:
    void follow(std::uint64_t drawn, std::chrono::nanoseconds period);

    render::FramePace pace_{std::chrono::milliseconds(8)}, cells_{std::chrono::milliseconds(8)};
    xr::RenderScale scale_;
    xr::RefreshRate rate_;
    std::uint64_t splats_ = render::FramePace::kFirst;
    std::uint64_t risen_ = 0;  // the least that would have fitted for so long:
    std::chrono::nanoseconds fits_{0}, wait_ = kWait, sinceRise_ = kCalm;

    static constexpr std::chrono::nanoseconds kWait = std::chrono::milliseconds(500),
                                              kLongestWait = std::chrono::seconds(2),
                                              kCalm = std::chrono::seconds(10);
};

}  // namespace app::headset
