// The ellipsoid that the splat of a cell of any shape fills (render/model/footprint.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/points/placed_points.h"
#include "timeseries/grid/lower_triangle.h"

namespace render {

// What is to be added to all squares of three singular values, so that none is below that of
// `least`: of which their product and the sum of their squares are known. The smallest square t,
// as a share of the sum, is a fixed point of t = k / (1 - t)^2 or more, k = 4 product^2 / sum^3,
// since two numbers' product is at most that of their mean with itself; it is met from below.
inline double growthTo(double least, double product, double sumOfSquares) {
    const double perRoot = 1 / std::sqrt(sumOfSquares);
    const double scaled = product * perRoot * perRoot * perRoot, k = 4 * scaled * scaled;
    double t = k;
    for (int i = 0; i < 3; ++i) t = k / ((1 - t) * (1 - t));
    return std::max(least * least - t * sumOfSquares, 0.0);
}

// L with L L^T = M M^T + g I.
inline timeseries::LowerTriangle<double> grownTo(double least,
                                                 const timeseries::LowerTriangle<double>& m) {
    const double squares = glm::dot(m.diagonal, m.diagonal) + glm::dot(m.below, m.below);
    // What a matrix of any volume leaves is more than rounding.
    return timeseries::factorOf(m.rows(), growthTo(least, std::abs(m.determinant()), squares),
                                1e-9 * least);
}

// What no semi-axis of a splat exceeds, `widest` being that of the cells, `least` the least radius.
inline double longestSemiAxis(const PlacedPoints& placed, double widest, double least) {
    constexpr double kThreeGrown = std::numbers::sqrt3;
    return placed.isMesh() ? std::hypot(widest, kThreeGrown * least) : std::max(widest, least);
}

}  // namespace render
