// The ramp clamp(x, 0, 1) that a pixel makes of an end of a range, and its means along a way from a
// to b: closed forms, and what they come to where a and b are too near for a quotient.
#pragma once

#include <algorithm>
#include <cmath>

namespace render {

// Of a ray along an axis, so that one along a face divides by something.
inline constexpr double kLeastStep = 1e-12;
// As floats have it, a change of f along a piece that is worth dividing by: less has lost more than
// a thousandth to rounding.
inline constexpr double kLeastDifference = 1e-4;

namespace cell {

// The mean of clamp(x, 0, 1) between a and b.
template <typename Real>
Real meanRamp(Real a, Real b) {
    const Real xa = std::clamp(a, Real(0), Real(1)), xb = std::clamp(b, Real(0), Real(1));
    const Real between = b - a;
    if (std::abs(between) < Real(kLeastStep)) return (xa + xb) / 2;
    return ((xb - xa) * (xb + xa) / 2 + (std::max(b, Real(1)) - std::max(a, Real(1)))) / between;
}

// The mean of what clamp(x, 0, 1) adds up to from 0 on, between a and b: 0, x^2 / 2, x - 1/2, as Q.
template <typename Real>
Real meanAboveRamp(Real a, Real b) {
    const auto within = [](Real x) { return std::clamp(x, Real(0), Real(1)); };
    const auto beyond = [](Real x) { return std::max(x - 1, Real(0)); };
    const Real between = b - a;
    if (std::abs(between) < Real(kLeastDifference)) {
        const Real x = (a + b) / 2;
        return within(x) * within(x) / 2 + beyond(x);
    }
    const auto sum = [&](Real x) {
        return within(x) * within(x) * within(x) / 6 + beyond(x) * (1 + beyond(x)) / 2;
    };
    return (sum(b) - sum(a)) / between;
}

}  // namespace cell
}  // namespace render
