#include "app/headset/snap_turn.h"

#include <cmath>

namespace app::headset {

int SnapTurn::update(bool holds, double stick) {
    const double out = std::abs(stick);
    const bool rests = out < kBack;
    if (holds)
        owns_ = true;
    else if (rests)
        owns_ = false;
    if (rests)
        ready_ = true;
    else if (!owns_)
        ready_ = false;
    if (!holds || !ready_ || out < kOut) return 0;
    ready_ = false;
    return stick > 0 ? 1 : -1;
}

xr::Placement turned(const xr::Placement& placement, int steps) {
    const glm::dquat turn = glm::angleAxis(steps * kSnapAngle, glm::dvec3(0, 1, 0));
    const xr::Pose& now = placement.stageFromVolume;
    return {{glm::normalize(turn * now.orientation), now.position}, placement.metresPerUnit};
}

}  // namespace app::headset
