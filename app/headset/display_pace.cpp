#include "app/headset/display_pace.h"

#include <algorithm>
#include <cmath>

namespace app::headset {

void DisplayPace::took(const FrameCost& frame) {
    if (frame.period.count() <= 0) return;
    governor_.setTarget(
        std::chrono::nanoseconds(std::llround(kShare * static_cast<double>(frame.period.count()))));
    // The pixels answer for what is left with the fewest splats alone.
    std::chrono::nanoseconds least = frame.work;
    if (frame.splats) {
        const auto& [count, fewest, took, areCells, finer] = *frame.splats;
        governor_.took({count, areCells, finer}, took, frame.period);
        const std::uint64_t left = std::max(render::FramePace::kFewest, fewest);
        if (count > left) least -= std::min(least, governor_.costOf({count - left, areCells}));
    }
    scale_.took(least, frame.period);
    rate_.took(least, scale_);
}

}  // namespace app::headset
