#include "app/drawing/governor.h"

#include <algorithm>

namespace app {

void Governor::setTarget(std::chrono::nanoseconds target) {
    target_ = target;
    points_.setTarget(target);
    cells_.setTarget(target);
}

void Governor::beginFrom(const DrawingCosts& learnt) {
    if (learnt.points) points_.beginFrom(*learnt.points);
    if (learnt.cells) cells_.beginFrom(*learnt.cells);
    proven_ = points_.budget();
}

void Governor::took(const Drawn& drawn, std::chrono::nanoseconds time,
                    std::chrono::nanoseconds since) {
    (drawn.areCells ? cells_ : points_).took(drawn.splats, time);
    if (drawn.areCells && mayTryCells())
        patience_ = time > target_ ? std::min(2 * patience_, kMostPatience) : kPatience;
    withoutCells_ = drawn.areCells ? 0 : withoutCells_ + 1;
    if (!drawn.areCells && rise_ == Rise::Proven) follow(drawn, since);
}

CanvasLimits Governor::limits(const DepthErrors* errors) const {
    return {.splats = rise_ == Rise::Proven ? proven_ : points_.budget(),
            .cells = mostCells(),
            .mayBeCoarse = true,
            .errors = errors};
}

std::uint64_t Governor::mostCells() const {
    if (!mayTryCells()) return cells_.budget();
    const unsigned whiles = std::min(withoutCells_ / patience_, cells_.isSure() ? 2u : 4u);
    return std::max(cells_.budget(), cells_.fitting((1u << (whiles - 1)) * target_));
}

// A rise too much is a fall at once, and so a swing: after one, the next rise has to wait longer.
void Governor::follow(const Drawn& drawn, std::chrono::nanoseconds since) {
    const std::uint64_t fit = points_.budget();
    sinceRise_ += since;
    if (sinceRise_ > kCalm) wait_ = kWait;
    if (fit < drawn.splats && fit < proven_ && sinceRise_ < kCalm)
        wait_ = std::min(2 * wait_, kLongestWait);
    proven_ = std::min(proven_, fit);
    if (static_cast<double>(fit) < drawn.finer * static_cast<double>(drawn.splats)) {
        fits_ = {};
        return;
    }
    risen_ = fits_.count() == 0 ? fit : std::min(risen_, fit);
    fits_ += since;
    if (fits_ < wait_ || risen_ <= proven_) return;
    proven_ = risen_;
    fits_ = sinceRise_ = {};
}

}  // namespace app
