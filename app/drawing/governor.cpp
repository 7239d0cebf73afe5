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
    withoutCells_ = drawn.areCells ? 0 : withoutCells_ + 1;
    if (rise_ == Rise::AtOnce) forgetSlowCells();
    if (!drawn.areCells && rise_ == Rise::Proven) follow(drawn, since);
}

CanvasLimits Governor::limits(const DepthErrors* errors) const {
    CanvasLimits limits{.splats = rise_ == Rise::Proven ? proven_ : points_.budget(),
                        .cells = cells_.budget(),
                        .mayBeCoarse = true,
                        .errors = errors};
    if (rise_ == Rise::AtOnce) limits.slower.emplace(slower());
    return limits;
}

CanvasLimits::Slower Governor::slower() const {
    render::FramePace points = points_, cells = cells_;
    points.setTarget(std::max(target_, kSlowest));
    cells.setTarget(std::max(target_, kSlowest));
    return {points.budget(), cells.budget()};
}

void Governor::forgetSlowCells() {
    if (cells_.budget() > firstCells_) patience_ = kPatience;
    if (cells_.budget() >= firstCells_ || withoutCells_ < patience_) return;
    cells_.forget();
    withoutCells_ = 0;
    patience_ = std::min(2 * patience_, kMostPatience);
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
