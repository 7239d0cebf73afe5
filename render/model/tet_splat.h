// A tetrahedron of an interval volume as one view sees it: the length that a pixel's ray has inside
// a range of values. What the cells of a grid whose points lie one by one are made of
// (render/splat/mesh_cells.h): tetrahedra with flat faces fill such a grid without gaps.
//
// A place is told by the shares b0 to b3 that the corners have in it (barycentric coordinates):
// linear functions of the place that add up to 1, all of them at least 0 inside. The field is
// f0 b0 + f1 b1 + f2 b2 + f3 b3. Along a ray all of these are linear, so a ray is inside between
// the last share that becomes positive and the first that becomes negative, and the field changes
// evenly on the way: one linear piece of render/model/cell_splat.h, whose formulas of what lies in
// the range and of pixels are used here as they stand.
// The kernels of render/splat/tet_kernels.cpp compute the same in float.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <utility>

#include "render/model/cell_splat.h"
#include "render/model/footprint.h"
#include "render/model/seen_bounds.h"

namespace render {

// Corners in axis coordinates, which are the world's where points lie one by one, with the field's
// values there, and the range.
struct ValuedTet {
    std::array<glm::dvec3, 4> at;
    std::array<double, 4> values;
    double lo, hi;
    OpacityPer per = OpacityPer::Length;
    // Of the field at the corners, by which light falls on it, in units of so much of the field;
    // null: its own everywhere.
    const std::array<glm::dvec3, 4>* gradients = nullptr;
    double gradientUnit = 1;
};

// Of the cube of its longest edge: a flatter one holds nothing, and its shares are no numbers.
inline constexpr double kFlattest = 1e-12;

// Six times the volume, positive where the corners are right-handed.
inline double turnOf(const std::array<glm::dvec3, 4>& at) {
    return glm::dot(at[1] - at[0], glm::cross(at[2] - at[0], at[3] - at[0]));
}
inline bool isFlat(const std::array<glm::dvec3, 4>& at, double turn) {
    double longest = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const glm::dvec3 edge = at[i] - at[k];
            longest = std::max(longest, glm::dot(edge, edge));
        }
    return !(std::abs(turn) > kFlattest * longest * std::sqrt(longest));
}

template <typename Real>
struct TetSplat {
    using Vec2 = glm::vec<2, Real>;
    bool visible = false;
    // As of CellSplat: places are counted from this view depth along the ray at `centre`, those of
    // the tetrahedron's middle, or the eye's where a corner is nearer than the near plane.
    Real base{};
    glm::dvec2 centre{0};
    Vec2 lo{}, hi{};
    // The corners' shares there, and how they change along that ray a unit of depth, and a pixel to
    // the right and up a unit of depth; and the field, as f, likewise.
    std::array<Real, 4> at{}, ray{}, x{}, y{};
    Real f{}, fRay{}, fX{}, fY{};
    Real across{};  // of f, a pixel, a unit of depth away
    Real widest{};  // ramp
    // The field is reference + extent f, f in [-1, 1].
    double reference = 0, extent = 0;
    Real least{}, most{};
    bool crossesLeast = false, crossesMost = false;
    Real perRange{};
    glm::dvec3 gradient{0};  // of f, along the axes, which are the world's
    double steepness = 0;    // its length
};

namespace tet {

// How the shares of the corners change: rows that add up to 0.
inline std::array<glm::dvec3, 4> slopesOf(const std::array<glm::dvec3, 4>& at) {
    const glm::dmat3 rows =
        glm::transpose(glm::inverse(glm::dmat3(at[1] - at[0], at[2] - at[0], at[3] - at[0])));
    return {-rows[0] - rows[1] - rows[2], rows[0], rows[1], rows[2]};
}

// What no view changes, of values between these. False where it takes nothing of the range.
template <typename Real>
bool seeField(TetSplat<Real>& s, const ValuedTet& tet, double low, double high,
              const std::array<glm::dvec3, 4>& slopes, double unitLength,
              std::array<double, 4>& f) {
    s.reference = 0.5 * low + 0.5 * high;
    s.extent = 0.5 * high - 0.5 * low;
    if (!(s.extent > 0)) return true;
    for (std::size_t i = 0; i < 4; ++i) {
        f[i] = (tet.values[i] - s.reference) / s.extent;
        s.gradient += f[i] * slopes[i];
    }
    s.steepness = glm::length(s.gradient);
    return cell::seeRange(s, tet, low, high, s.steepness * unitLength);
}

// The gradients of f at the corners by which light falls on it, as ValuedTet has the field's.
template <typename Real>
std::array<glm::dvec3, 4> gradientsOf(const TetSplat<Real>& s,
                                      const std::array<glm::dvec3, 4>* ofField, double unit) {
    constexpr double kMost = 1e15;  // its square is a float
    constexpr double kMostUnits = 1e30;
    std::array<glm::dvec3, 4> of{};
    if (!(s.extent > 0)) return of;
    const double per = std::min(unit / s.extent, kMostUnits);
    for (std::size_t i = 0; i < 4; ++i)
        of[i] = glm::clamp(ofField ? per * (*ofField)[i] : s.gradient, -kMost, kMost);
    return of;
}

}  // namespace tet

template <typename Real>
TetSplat<Real> tetSplatAt(const PointsView& view, const ValuedTet& tet) {
    using Vec2 = glm::vec<2, Real>;
    constexpr double kFar = std::numeric_limits<double>::max();
    TetSplat<Real> s;
    const auto [low, high] = std::minmax_element(tet.values.begin(), tet.values.end());
    if (!cell::touches(*low, *high, tet.lo, tet.hi)) return s;
    const PixelRays& rays = view.rays;
    std::array<glm::dvec3, 4> seen;
    double nearest = kFar, farthest = -kFar;
    glm::dvec3 middle(0);
    for (std::size_t i = 0; i < 4; ++i) {
        seen[i] = glm::dvec3(view.viewFromAxes * glm::dvec4(tet.at[i], 1.0));
        nearest = std::min(nearest, -seen[i].z);
        farthest = std::max(farthest, -seen[i].z);
        middle += 0.25 * seen[i];
    }
    if (!(farthest > rays.near) || isFlat(tet.at, turnOf(tet.at))) return s;
    const std::array<glm::dvec3, 4> slopes = tet::slopesOf(tet.at);
    std::array<double, 4> f{};
    s.visible = tet::seeField(s, tet, *low, *high, slopes, view.unitLength, f);
    if (!s.visible) return s;
    std::array<double, 4> at{0.25, 0.25, 0.25, 0.25};
    if (nearest > rays.near) {
        constexpr double kMore = 0.01;  // than arithmetic loses
        s.base = static_cast<Real>(-middle.z);
        s.centre = rays.focal * glm::dvec2(middle) / -middle.z;
        glm::dvec2 least(kFar), most(-kFar);
        for (const glm::dvec3& corner : seen) {
            const glm::dvec2 offset = rays.focal * glm::dvec2(corner) / -corner.z - s.centre;
            least = glm::min(least, offset);
            most = glm::max(most, offset);
        }
        s.lo = Vec2(least - kMore);
        s.hi = Vec2(most + kMore);
    } else {
        for (std::size_t i = 1; i < 4; ++i) at[i] = glm::dot(slopes[i], rays.eye - tet.at[0]);
        at[0] = 1 - at[1] - at[2] - at[3];
        SeenBounds bounds(rays);
        bounds.takeHull(seen);
        s.lo = inFloats<Real>(bounds.lo());
        s.hi = inFloats<Real>(bounds.hi());
    }
    const glm::dvec3 ray = rays.along(s.centre);
    const auto changeOf = [&](const glm::dvec3& way) {  // of the shares
        return glm::dvec4(glm::dot(slopes[0], way), glm::dot(slopes[1], way),
                          glm::dot(slopes[2], way), glm::dot(slopes[3], way));
    };
    const glm::dvec4 field(f[0], f[1], f[2], f[3]), shares(at[0], at[1], at[2], at[3]);
    const glm::dvec4 r = changeOf(ray);
    glm::dvec4 x = changeOf(rays.perPixelX), y = changeOf(rays.perPixelY);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto k = static_cast<int>(i);
        s.at[i] = static_cast<Real>(at[i]);
        s.ray[i] = static_cast<Real>(r[k]);
        s.x[i] = static_cast<Real>(x[k]);
        s.y[i] = static_cast<Real>(y[k]);
    }
    s.f = static_cast<Real>(glm::dot(field, shares));
    s.fRay = static_cast<Real>(glm::dot(field, r));
    s.fX = static_cast<Real>(glm::dot(field, x));
    s.fY = static_cast<Real>(glm::dot(field, y));
    const double flat = cell::alongCell(r, static_cast<double>(s.base), x, y);
    s.across = static_cast<Real>(std::hypot(glm::dot(field, x), glm::dot(field, y)));
    s.widest = cell::widestRamp(s, s.crossesLeast, s.crossesMost, static_cast<Real>(flat));
    return s;
}

// Of the ray of a pixel, `offset` pixels from the centre, the way inside: depths from the base, as
// far as view depth `opaque`; from >= to where it passes by.
template <typename Real>
std::pair<Real, Real> wayThrough(const PointsView& view, const TetSplat<Real>& s,
                                 const glm::vec<2, Real>& offset, Real opaque) {
    Real from = static_cast<Real>(view.rays.near) - s.base, to = opaque - s.base;
    for (std::size_t i = 0; i < 4; ++i) {
        const Real shift = offset.x * s.x[i] + offset.y * s.y[i];
        const Real at = s.at[i] + s.base * shift, along = s.ray[i] + shift;
        const Real step = std::copysign(std::max(std::abs(along), Real(kLeastStep)), along);
        (step > 0 ? from : to) = step > 0 ? std::max(from, -at / step) : std::min(to, -at / step);
    }
    return {from, to};
}

// As of a cell, on the ray of a pixel, `offset` pixels from the tetrahedron's centre, as far as
// view depth `opaque`.
template <typename Real>
CellFragment<Real> fragmentOn(const PointsView& view, const TetSplat<Real>& s,
                              const glm::vec<2, Real>& offset, Real opaque) {
    using Vec2 = glm::vec<2, Real>;
    const auto [from, to] = wayThrough(view, s, offset, opaque);
    if (!(to > from)) return {};
    const Vec2 slope = (offset + Vec2(s.centre)) / Vec2(view.rays.focal);
    const Real whole = static_cast<Real>(view.rayLength / view.unitLength) * (to - from) *
                       std::sqrt(1 + glm::dot(slope, slope));
    const Real shift = offset.x * s.fX + offset.y * s.fY;
    const Real value = s.f + s.base * shift, change = s.fRay + shift;
    const Real begin = value + from * change, end = value + to * change;
    if (!s.crossesLeast && !s.crossesMost) return {whole, (begin + end) / 2};
    const Real width =
        std::clamp((s.base + (from + to) / 2) * s.across, Real(2 * kLeastChange), s.widest);
    const CellFragment<Real> part = cell::withinRange(
        s, begin, end, width, std::max(whole, std::abs(end - begin) * s.perRange));
    return part.weight > 0 ? part : CellFragment<Real>{};
}

}  // namespace render
