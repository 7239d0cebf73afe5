#include "xr/grab.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace xr {
namespace {

// The volume keeps its pose in the hand.
Placement carried(const Placement& now, const Pose& before, const Pose& hand) {
    return {hand * inverse(before) * now.stageFromVolume, now.metresPerUnit};
}

struct Hands {
    glm::dvec3 middle, line;
    Hands(const Pose& a, const Pose& b)
        : middle(0.5 * (a.position + b.position)), line(b.position - a.position) {}
    double distance() const { return glm::length(line); }
};

// The point of the volume that lay between the hands stays there.
Placement stretched(const Placement& now, const Hands& before, const Hands& hands) {
    glm::dquat turn{1, 0, 0, 0};
    double metres = now.metresPerUnit;
    if (before.distance() >= kNearestHands && hands.distance() >= kNearestHands) {
        turn = glm::dquat(before.line, hands.line);
        metres = std::clamp(metres * hands.distance() / before.distance(), kSmallestMetres,
                            kLargestMetres);
    }
    const glm::dvec3 fromMiddle = now.stageFromVolume.position - before.middle;
    return {{glm::normalize(turn * now.stageFromVolume.orientation),
             hands.middle + metres / now.metresPerUnit * (turn * fromMiddle)},
            metres};
}

}  // namespace

Placement Grab::update(const Placement& now, const std::array<std::optional<Pose>, 2>& holding) {
    const auto before = std::exchange(before_, holding);
    const auto& [left, right] = holding;
    if (before[0].has_value() != left.has_value() || before[1].has_value() != right.has_value())
        return now;
    if (left && right) return stretched(now, Hands(*before[0], *before[1]), Hands(*left, *right));
    if (left) return carried(now, *before[0], *left);
    if (right) return carried(now, *before[1], *right);
    return now;
}

}  // namespace xr
