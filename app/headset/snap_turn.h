// Turning the volume by steps with the stick of a hand that holds it. Pure.
//
// It is the volume that turns, at once, and never the user: nothing moves smoothly past the eyes,
// so no vignette is needed.
#pragma once

#include <numbers>

#include "xr/pose.h"

namespace app::headset {

inline constexpr double kSnapAngle = std::numbers::pi / 6;

// One hand's stick.
class SnapTurn {
 public:
    // Farther out than kOut is a flick; until the stick was nearer than kBack, there is no other.
    static constexpr double kOut = 0.7, kBack = 0.4;

    // `stick`: to the right, [-1, 1]. Returns the steps to turn now: 1 to the right, -1 to the
    // left. A stick that was out before the hand took hold turns nothing.
    int update(bool holds, double stick);
    // Whether the stick is for turning, and must not move anything else: while the hand holds, and
    // after it until the stick has come back.
    bool owns() const { return owns_; }

 private:
    bool ready_ = true, owns_ = false;
};

// About the vertical through its middle; to the right, the side near the user goes right.
xr::Placement turned(const xr::Placement& placement, int steps);

}  // namespace app::headset
