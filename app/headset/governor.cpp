#include "app/headset/governor.h"

#include <algorithm>
#include <cmath>

namespace app::headset {

void Governor::took(const FrameCost& frame) {
    if (frame.period.count() <= 0) return;
    const auto target =
        std::chrono::nanoseconds(std::llround(kShare * static_cast<double>(frame.period.count())));
    pace_.setTarget(target);
    cells_.setTarget(target);
    // The pixels answer for what is left with the fewest splats alone.
    std::chrono::nanoseconds least = frame.work;
    if (frame.splats) {
        const auto& [count, fewest, took, areCells] = *frame.splats;
        render::FramePace& pace = areCells ? cells_ : pace_;
        pace.took(count, took);
        if (!areCells) follow(count, frame.period);
        const std::uint64_t left = std::max(render::FramePace::kFewest, fewest);
        if (count > left) least -= std::min(least, pace.costOf(count - left));
    }
    scale_.took(least, frame.period);
    rate_.took(least, scale_);
}

// A subset draws half as many splats as the next finer one. A rise too much is a fall at once, and
// so a swing: after one, the next rise has to wait longer.
void Governor::follow(std::uint64_t drawn, std::chrono::nanoseconds period) {
    const std::uint64_t fit = pace_.budget();
    sinceRise_ += period;
    if (sinceRise_ > kCalm) wait_ = kWait;
    if (fit < drawn && fit < splats_ && sinceRise_ < kCalm)
        wait_ = std::min(2 * wait_, kLongestWait);
    splats_ = std::min(splats_, fit);
    if (fit < 2 * drawn) {
        fits_ = {};
        return;
    }
    risen_ = fits_.count() == 0 ? fit : std::min(risen_, fit);
    fits_ += period;
    if (fits_ < wait_ || risen_ <= splats_) return;
    splats_ = risen_;
    fits_ = sinceRise_ = {};
}

}  // namespace app::headset
