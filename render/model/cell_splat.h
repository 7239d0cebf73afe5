// One cell of an interval volume as one view sees it: the length that a pixel's ray has inside a
// range of values. The field in a cell is trilinear between its eight corners; along a ray it is
// taken as two linear pieces, from where the ray enters to the middle and on to where it leaves.
//
// Of a piece of length s along which f goes from fa to fb, the part in the range is
// s (K(fb) - K(fa)) / (fb - fa), K being the integral of membership: 1 inside the range and 0
// outside, and over a pixel, across which f changes by 2 delta, a ramp of that width about each
// end:
//   K(f) = 2 delta (Q((f - lo + delta) / 2 delta) - Q((f - hi + delta) / 2 delta)),
//   Q(x) = 0, x^2 / 2, x - 1/2 below 0, between, and above 1.
// An end that the cell does not cross is left out, or a plateau at the end's value would count
// half.
//
// W is that length in units of l, as of splats (render/model/footprint.h). Cells do not overlap.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "render/model/footprint.h"

namespace render {

// A box in axis coordinates with the field's values at its corners, x fastest, and the range.
struct ValuedCell {
    glm::dvec3 from, to;  // opposite corners, in the order of indices
    std::array<double, 8> corners;
    double lo, hi;
};

template <typename Real>
struct CellSplat {
    using Vec2 = glm::vec<2, Real>;
    using Vec3 = glm::vec<3, Real>;
    bool visible = false;
    // Places are counted from this view depth, along the ray at this offset from the view axis, in
    // pixels: those of the cell's middle, or the eye's where a corner is nearer than the near
    // plane.
    Real base{};
    Vec2 centre{};
    Vec2 lo{}, hi{};  // offsets from there between which the cell lies
    // In units of the cell, [0, 1] in it: the place there, that ray a unit of depth, and what a
    // pixel adds to it.
    Vec3 at{}, ray{}, x{}, y{};
    Real near{};    // view depth of the near plane
    Real weight{};  // W of a unit of depth along the view axis
    // Values less `reference`.
    std::array<Real, 8> corners{};
    Real leastDelta{};     // what rounding makes of their differences
    Real least{}, most{};  // of the range
    bool crossesLeast = false, crossesMost = false;
    double reference = 0;
};

template <typename Real>
CellSplat<Real> cellSplatAt(const PointsView& view, const ValuedCell& cell) {
    using Vec2 = glm::vec<2, Real>;
    using Vec3 = glm::vec<3, Real>;
    CellSplat<Real> s;
    const auto [lo, hi] = std::minmax_element(cell.corners.begin(), cell.corners.end());
    // One that only touches the range takes nothing of it.
    const bool reaches = *lo < *hi ? *lo<cell.hi&& * hi> cell.lo : *lo <= cell.hi && *hi >= cell.lo;
    if (!reaches) return s;
    const PixelRays& rays = view.rays;
    const glm::dvec2 focal = rays.focal;
    const auto seen = [&](const glm::dvec3& axes) {
        return glm::dvec3(view.viewFromAxes * glm::dvec4(axes, 1.0));
    };
    glm::dvec2 least(std::numeric_limits<double>::infinity()), most = -least;
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (int c = 0; c < 8; ++c) {
        const glm::dvec3 v = seen({c & 1 ? cell.to.x : cell.from.x, c & 2 ? cell.to.y : cell.from.y,
                                   c & 4 ? cell.to.z : cell.from.z});
        nearest = std::min(nearest, -v.z);
        farthest = std::max(farthest, -v.z);
        least = glm::min(least, focal * glm::dvec2(v) / -v.z);
        most = glm::max(most, focal * glm::dvec2(v) / -v.z);
    }
    if (!(farthest > rays.near)) return s;
    s.visible = true;
    const glm::dvec3 size = cell.to - cell.from;
    glm::dvec2 centre(0);
    double base = 0;
    glm::dvec3 at = (rays.eye - cell.from) / size;
    if (nearest > rays.near) {
        const glm::dvec3 middle = seen(0.5 * (cell.from + cell.to));
        base = -middle.z;
        centre = focal * glm::dvec2(middle) / base;
        at = glm::dvec3(0.5);
        s.lo = Vec2(least - centre);
        s.hi = Vec2(most - centre);
    } else {
        s.lo = Vec2(-std::numeric_limits<Real>::infinity());
        s.hi = -s.lo;
    }
    s.base = static_cast<Real>(base);
    s.centre = Vec2(centre);
    s.at = Vec3(at);
    s.ray = Vec3((rays.axis + centre.x * rays.perPixelX + centre.y * rays.perPixelY) / size);
    s.x = Vec3(rays.perPixelX / size);
    s.y = Vec3(rays.perPixelY / size);
    s.near = static_cast<Real>(rays.near);
    s.weight = static_cast<Real>(view.rayLength / view.unitLength);
    s.reference = 0.5 * *lo + 0.5 * *hi;
    for (std::size_t c = 0; c < 8; ++c)
        s.corners[c] = static_cast<Real>(cell.corners[c] - s.reference);
    s.leastDelta = static_cast<Real>(1e-5 * (0.5 * *hi - 0.5 * *lo));
    s.crossesLeast = *lo < cell.lo;
    s.crossesMost = *hi > cell.hi;
    if (s.crossesLeast) s.least = static_cast<Real>(cell.lo - s.reference);
    if (s.crossesMost) s.most = static_cast<Real>(cell.hi - s.reference);
    return s;
}

namespace cell {

template <typename Real>
Real mix(Real a, Real b, Real t) {
    return a + t * (b - a);
}

// Of the field at a place of the cell.
template <typename Real>
Real valueAt(const std::array<Real, 8>& f, const glm::vec<3, Real>& u) {
    const Real low = mix(mix(f[0], f[1], u.x), mix(f[2], f[3], u.x), u.y);
    const Real high = mix(mix(f[4], f[5], u.x), mix(f[6], f[7], u.x), u.y);
    return mix(low, high, u.z);
}
// A unit of the cell.
template <typename Real>
glm::vec<3, Real> gradientAt(const std::array<Real, 8>& f, const glm::vec<3, Real>& u) {
    const auto across = [&](int low, int step, Real v, Real w, int sv, int sw) {
        const auto d = [&](int i) { return f[i + step] - f[i]; };
        return mix(mix(d(low), d(low + sv), v), mix(d(low + sw), d(low + sv + sw), v), w);
    };
    return {across(0, 1, u.y, u.z, 2, 4), across(0, 2, u.x, u.z, 1, 4),
            across(0, 4, u.x, u.y, 1, 2)};
}

// The integral of a ramp from 0 at -delta to 1 at delta, and the ramp.
template <typename Real>
Real rampIntegral(Real f, Real delta) {
    const Real x = std::clamp((f + delta) / (2 * delta), Real(0), Real(1));
    return delta * x * x + std::max(f - delta, Real(0));
}
template <typename Real>
Real ramp(Real f, Real delta) {
    return std::clamp((f + delta) / (2 * delta), Real(0), Real(1));
}

// The mean of membership along a piece from fa to fb.
template <typename Real>
Real share(const CellSplat<Real>& s, Real fa, Real fb, Real delta) {
    if (std::abs(fb - fa) < Real(1e-2) * delta) {  // what is left of the difference says little
        const Real f = (fa + fb) / 2;
        return (s.crossesLeast ? ramp(f - s.least, delta) : Real(1)) -
               (s.crossesMost ? ramp(f - s.most, delta) : Real(0));
    }
    const auto integral = [&](Real f) {
        return (s.crossesLeast ? rampIntegral(f - s.least, delta) : f) -
               (s.crossesMost ? rampIntegral(f - s.most, delta) : Real(0));
    };
    return (integral(fb) - integral(fa)) / (fb - fa);
}

}  // namespace cell

template <typename Real>
struct CellFragment {
    Real weight{};  // W, no less than 0
    Real value{};   // less the cell's reference: of the field there, within the range
};

// On the ray of a pixel, `offset` pixels from the cell's centre and of this x / -z and y / -z, as
// far as view depth `opaque`.
template <typename Real>
CellFragment<Real> fragmentOn(const CellSplat<Real>& s, const glm::vec<2, Real>& offset,
                              const glm::vec<2, Real>& slope, Real opaque) {
    using Vec3 = glm::vec<3, Real>;
    constexpr Real kLeastStep = Real(1e-12);  // so that a ray along a face divides by something
    const Vec3 shift = offset.x * s.x + offset.y * s.y;
    const Vec3 at = s.at + s.base * shift, along = s.ray + shift;
    Real from = s.near - s.base, to = opaque - s.base;
    for (int a = 0; a < 3; ++a) {
        const Real step = std::abs(along[a]) < kLeastStep ? kLeastStep : along[a];
        const Real one = -at[a] / step, other = (1 - at[a]) / step;
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
    }
    if (!(to > from)) return {};
    const Real whole = s.weight * (to - from) * std::sqrt(1 + glm::dot(slope, slope));
    const Real half = (from + to) / 2;
    const Vec3 middle = at + half * along;
    const Real f = cell::valueAt(s.corners, middle);
    if (!s.crossesLeast && !s.crossesMost) return {whole, f};
    const Vec3 gradient = cell::gradientAt(s.corners, middle);
    // Half of what the pixel's width and height change together; no less than rounding does.
    const Real depth = s.base + half;
    const Real delta = std::max(
        depth / 2 * (std::abs(glm::dot(gradient, s.x)) + std::abs(glm::dot(gradient, s.y))),
        s.leastDelta);
    const Real first = cell::valueAt(s.corners, at + from * along);
    const Real last = cell::valueAt(s.corners, at + to * along);
    const Real before = std::clamp(cell::share(s, first, f, delta), Real(0), Real(1));
    const Real after = std::clamp(cell::share(s, f, last, delta), Real(0), Real(1));
    if (!(before + after > 0)) return {};
    // What of a linear piece lies in the range has the mean of its ends there.
    const auto within = [&](Real v) {
        if (s.crossesLeast) v = std::max(v, s.least);
        return s.crossesMost ? std::min(v, s.most) : v;
    };
    const Real value = (before * (within(first) + within(f)) + after * (within(f) + within(last))) /
                       (2 * (before + after));
    return {whole * (before + after) / 2, value};
}

}  // namespace render
