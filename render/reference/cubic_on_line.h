// A trilinear field along a straight line in its cell: a cubic, and where it lies in a range. In
// double, exact but for rounding; in the Bernstein basis, whose coefficients bound the values
// between them.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace render {

// Coefficients of (1 - t)^3, 3 t (1 - t)^2, 3 t^2 (1 - t), t^3 for t in [0, 1].
using Cubic = std::array<double, 4>;

// From `from` to `to`, places in units of the cell; corners x fastest. Each coefficient is the
// field's blossom (Ramshaw 1989): the mean over the axes' orders of the trilinear form with one of
// the two places along each axis.
Cubic cubicOnLine(const std::array<double, 8>& corners, const glm::dvec3& from,
                  const glm::dvec3& to);
double valueAt(const Cubic& cubic, double t);

struct LinePart {
    double from, to;  // of [0, 1]
    friend bool operator==(const LinePart&, const LinePart&) = default;
};
// Adds the parts of the line on which lo <= cubic <= hi: disjoint, ascending. Ends may be infinite.
// REQUIRES: coefficients near 1, whose differences neither overflow nor vanish.
void addPartsWithin(const Cubic& cubic, double lo, double hi, std::vector<LinePart>& into);
// The integral of max(whole, |cubic'| / width) over these parts: what opacity is of where a passage
// through a range of that width counts (OpacityPer::Crossing), of a line that is so long. The width
// may be infinite. REQUIRES: the same; width > 0.
double passageWithin(const Cubic& cubic, double lo, double hi, double width, double whole);

}  // namespace render
