// Moving the volume by hand: one hand carries and turns it, two hands scale and turn it about their
// midpoint. Pure: poses in, placement out.
#pragma once

#include <array>
#include <optional>

#include "xr/pose.h"

namespace xr {

// Metres a unit (half the box's diagonal) may be: a thimble to a hall.
inline constexpr double kSmallestMetres = 0.02, kLargestMetres = 20;
// Hands nearer than this to each other only carry: the line between them means nothing.
inline constexpr double kNearestHands = 0.01;

class Grab {
 public:
    // Which hands hold the volume now, and where (grip poses in the stage); the placement that
    // follows. A change of hands begins anew from where the volume is, so that nothing jumps. One
    // hand: the volume moves rigidly with it. Two: position, and rotation about the shortest turn
    // of the line between the hands, follow their midpoint; the scale is the ratio of their
    // distances, clamped.
    Placement update(const Placement& now, const std::array<std::optional<Pose>, 2>& holding);

 private:
    std::array<std::optional<Pose>, 2> before_;
};

}  // namespace xr
