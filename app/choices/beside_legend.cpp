#include "app/choices/beside_legend.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace app {
namespace {

// The shortest way by `depth` along `up`, left and up of length 1, to the other side, right by
// `most.x` and down by `most.y` at most.
std::optional<glm::dvec2> away(const glm::dvec2& up, double depth, const glm::dvec2& most) {
    if (depth <= 0) return glm::dvec2(0);
    const glm::dvec2 back(-up.x, up.y);  // right and down
    glm::dvec2 by = glm::min(depth * back, most);
    // What one direction lacks the other has to give.
    for (int k = 0; k < 2; ++k) {
        const double lacking = depth - glm::dot(by, back);
        if (lacking > 0 && back[k] > 0) by[k] = std::min(by[k] + lacking / back[k], most[k]);
    }
    constexpr double kRounding = 1e-9;
    if (glm::dot(by, back) < depth * (1 - kRounding)) return std::nullopt;
    return glm::dvec2(by.x, -by.y);
}

}  // namespace

std::optional<glm::dvec2> leastShift(std::span<const glm::dvec2> outline,
                                     const RoomInPicture& room) {
    glm::dvec2 lo(std::numeric_limits<double>::infinity()), hi(-lo);
    for (const glm::dvec2& at : outline) {
        lo = glm::min(lo, at);
        hi = glm::max(hi, at);
    }
    const glm::dvec2 most =
        glm::max(glm::dvec2(room.half.x - hi.x, lo.y + room.half.y), glm::dvec2(0));
    std::optional<glm::dvec2> least;
    for (int degrees = 0; degrees <= 90; ++degrees) {  // of the line, from upright to level
        const double turn = glm::radians(static_cast<double>(degrees));
        const glm::dvec2 up(-std::cos(turn), std::sin(turn));
        double farthest = -std::numeric_limits<double>::infinity();
        for (const glm::dvec2& at : outline) farthest = std::max(farthest, glm::dot(up, at));
        const auto by = away(up, farthest - glm::dot(up, room.legendCorner), most);
        if (by && (!least || glm::length(*by) < glm::length(*least))) least = by;
    }
    return least;
}

}  // namespace app
