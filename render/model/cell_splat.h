// One cell of an interval volume as one view sees it: the length that a pixel's ray has inside a
// range of values. The field in a cell is trilinear between its eight corners, so that along a ray
// it is a cubic, which is taken as linear pieces of equal length.
//
// Membership of a value is 1 inside the range and 0 outside, and over a pixel a ramp about each
// end. Of a field that changes by (x, y) across the pixel's width and height, the values in it
// have the variance (x^2 + y^2) / 12, which is that of a ramp of width sqrt(x^2 + y^2). With a
// and b the places of a piece's ends on such a ramp, clamp(x, 0, 1), its mean along the piece is
//   (Q(b) - Q(a)) / (b - a),  Q(x) = 0, x^2 / 2, x - 1/2 below 0, between, and above 1,
// and of a range the difference of the means of two ramps. An end that the cell does not cross is
// left out, or a plateau at the end's value would count half. What a ramp has beyond the values of
// the cell is in others, of which those that the range does not reach are not drawn. So where cells
// are flat, a pixel's steps lead along them, not into the next (alongCell), and no ramp is wider
// than keeps it within the values of its cell (widestRamp).
//
// A colour by value is the mean of the map over the values that a pixel sees of a cell, or where it
// hides what is behind, over those of its front (shareFromFront): the colour of their mean would be
// another where a shell of many colours lies in two cells on one ray, and cells would show.
//
// W is that length in units of l, as of splats (render/model/footprint.h), or, where opacity is of
// a crossing, of each piece what it changes of the range's width, if that is more. Cells do not
// overlap.
// The kernels of render/splat/cell_kernels.cpp and shaders/cell.* compute the same in float.
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
#include "render/model/ramps.h"
#include "render/model/scene.h"
#include "render/model/seen_bounds.h"

namespace render {

// A box in axis coordinates with the field's values at its corners, x fastest, and the range.
struct ValuedCell {
    glm::dvec3 from, to;  // opposite corners, in the order of indices
    std::array<double, 8> corners;
    double lo, hi;
    OpacityPer per = OpacityPer::Length;
};

// Of the field along a ray. Two miss where it turns: a shell of a twentieth of the step between
// points is a third farther from the truth then; a fourth piece gains a twentieth.
inline constexpr std::size_t kPieces = 3;
// Less than this of the cell's own change is what rounding leaves of a difference.
inline constexpr double kLeastChange = 1e-5;
// Of half the cell's own change: what is crossed is no thinner, or rounding would show.
inline constexpr double kThinnest = 1e-2;
// Of a cell, how much of it a pixel may step aside for it not to be flat, and to be all flat.
inline constexpr double kOrdinaryStep = 0.25, kFlatStep = 0.5;
// Of what f is in a cell, [-1, 1], how wide a ramp may always be, for a smooth edge.
inline constexpr double kNarrowRamp = 0.125;
// And about an end that two cells share: what a third of a cell changes, if that is along one axis.
inline constexpr double kSharedRamp = 2.0 / 3;

template <typename Real>
struct CellSplat {
    using Vec2 = glm::vec<2, Real>;
    using Vec3 = glm::vec<3, Real>;
    bool visible = false;
    // Places are counted from this view depth, along the ray at this offset from the view axis, in
    // pixels: those of the cell's middle, or the eye's where a corner is nearer than the near
    // plane.
    Real base{};
    glm::dvec2 centre{0};
    Vec2 lo{}, hi{};  // offsets from there between which the cell lies, or a little more
    // In units of the cell, [-1/2, 1/2] in it: the place there, and that ray a unit of depth.
    Vec3 at{}, ray{};
    Vec3 right{}, up{};  // a pixel's steps, as they are seen of this cell (alongCell)
    Real widest{};       // ramp
    Vec3 perSize{};      // units of the cell a length in axis coordinates, signed
    // The field is reference + extent f, f in [-1, 1] at the corners being the sum of these times
    // 1, u, v, w, uv, uw, vw, uvw at a place (u, v, w).
    std::array<Real, 8> f{};
    double reference = 0, extent = 0;
    Real least{}, most{};  // of the range, as f
    bool crossesLeast = false, crossesMost = false;
    // What a change of f is of the range's width; 0 where no passage counts for more than its
    // length.
    Real perRange{};
};

// Of what absorbs evenly along a way, to an optical depth x in all, where the light that leaves it
// comes from in the mean: this share of the way from the front,
//   1 / x - 1 / (e^x - 1) = 1/2 - x / 12 + x^3 / 720 - ...
// as a quotient that has these terms and the limit 1 / x; to 0.025.
template <typename Real>
Real shareFromFront(Real x) {
    return (1 + x / 12) / (2 + x / 2 + x * x / 12);
}

template <typename Real>
struct CellFragment {
    Real weight{};  // W, no less than 0
    Real value{};   // as f: of the field there, within the range
};

namespace cell {

// Of what is trilinear, at a place of the cell, from its corners.
template <typename Value, typename Real>
Value valueAt(const std::array<Value, 8>& f, const glm::vec<3, Real>& u) {
    const auto mix = [](const Value& a, const Value& b, Real t) { return a + t * (b - a); };
    const Value low = mix(mix(f[0], f[1], u.x), mix(f[2], f[3], u.x), u.y);
    const Value high = mix(mix(f[4], f[5], u.x), mix(f[6], f[7], u.x), u.y);
    return mix(low, high, u.z);
}

// As CellSplat::f, of values at the corners.
template <typename Real>
std::array<Real, 8> coefficients(const std::array<Real, 8>& corners) {
    std::array<Real, 8> c = corners;
    for (unsigned step : {1u, 2u, 4u})
        for (unsigned i = 0; i < 8; ++i)
            if ((i & step) == 0) {
                const Real a = c[i], b = c[i + step];
                c[i] = (a + b) / 2;
                c[i + step] = b - a;
            }
    return {c[0], c[1], c[2], c[4], c[3], c[5], c[6], c[7]};
}

inline bool touches(double least, double greatest, double lo, double hi) {
    return least <= hi && greatest >= lo;
}
// One that only touches the range has no length in it.
inline bool reaches(double least, double greatest, double lo, double hi) {
    return least < greatest ? least < hi && greatest > lo : touches(least, greatest, lo, hi);
}

// The range in a cell, or a tetrahedron, whose least and greatest corners are these, and of which f
// changes over the unit length l by `mostPerUnit` at most. False where it takes nothing of it: of a
// passage that counts however thin it is, also one that touches the range has what a pixel sees of
// it on this side of the end.
template <typename Real, template <typename> typename Splat, typename Valued>
bool seeRange(Splat<Real>& s, const Valued& cell, double least, double greatest,
              double mostPerUnit) {
    const auto within = [&](double end) {  // in halves, the whole may overflow
        return 2 * ((0.5 * end - 0.5 * s.reference) / s.extent);
    };
    const bool isThin =
        cell.per == OpacityPer::Crossing && s.extent / (cell.hi - cell.lo) * mostPerUnit > 1;
    s.crossesLeast = isThin || least < cell.lo;
    s.crossesMost = isThin || greatest > cell.hi;
    if (s.crossesLeast) s.least = static_cast<Real>(within(cell.lo));
    if (s.crossesMost) s.most = static_cast<Real>(within(cell.hi));
    if (!isThin) return reaches(least, greatest, cell.lo, cell.hi);
    // Both ends, also one that the cell does not reach: what a pixel sees of the field beyond the
    // other is not in the range.
    const Real middle = (s.least + s.most) / 2;
    const Real way = std::max(s.most - middle, Real(kThinnest / 2));
    s.least = middle - way;
    s.most = middle + way;
    s.perRange = 1 / (2 * way);
    return true;
}

// The field reference + extent f by which a piece's values have colours: what stands for a range
// that seeRange() widened has its own.
struct ColoredField {
    double reference, extent;
};
inline ColoredField coloredField(const ColoredField& field, bool isThin, double lo, double hi) {
    if (!isThin) return field;
    const double middle = 0.5 * lo + 0.5 * hi;
    const double share = std::min((0.5 * hi - 0.5 * lo) / field.extent / (kThinnest / 2), 1.0);
    return {middle + share * (field.reference - middle), share * field.extent};
}
template <typename Splat, typename Valued>
ColoredField coloredField(const Splat& s, const Valued& piece) {
    return coloredField({s.reference, s.extent}, s.perRange > 0, piece.lo, piece.hi);
}

// What no view changes: the field in the cell, and the range. False where the cell takes nothing of
// it.
template <typename Real>
bool seeField(CellSplat<Real>& s, const ValuedCell& cell, double unitLength) {
    const auto [lo, hi] = std::minmax_element(cell.corners.begin(), cell.corners.end());
    if (!touches(*lo, *hi, cell.lo, cell.hi)) return false;
    s.reference = 0.5 * *lo + 0.5 * *hi;
    s.extent = 0.5 * *hi - 0.5 * *lo;
    if (!(s.extent > 0)) return true;
    std::array<double, 8> f{};
    for (std::size_t c = 0; c < 8; ++c) f[c] = (cell.corners[c] - s.reference) / s.extent;
    f = cell::coefficients(f);
    for (std::size_t c = 0; c < 8; ++c) s.f[c] = static_cast<Real>(f[c]);
    // f changes by no more than 2 along an edge.
    return seeRange(s, cell, *lo, *hi, 2 * glm::length(unitLength / (cell.to - cell.from)));
}

// How wide a ramp about each end of the range may be, of a cell that is so flat. An end at the
// cell's least or greatest value is its neighbour's as well, which takes the ramp's other half.
// Where it is there and where no more, arithmetic does not decide: ends of whole numbers lie at any
// share of a cell.
template <typename Real, typename Splat>
Real widestRamp(const Splat& s, bool crossesLeast, bool crossesMost, Real flat) {
    constexpr Real kAny = Real(1e18);  // its square is a float
    if (!(flat > 0)) return kAny;
    Real widest = kAny;
    const auto limit = [&](Real end) {
        const Real beside = std::abs(1 - std::abs(end));
        const Real shared = std::clamp(2 - beside / Real(kThinnest / 2), Real(0), Real(1));
        const Real own = std::min(2 * beside, kAny);
        widest = std::min(widest, own + shared * (Real(kSharedRamp) - own));
    };
    if (crossesLeast) limit(s.least);
    if (crossesMost) limit(s.most);
    return std::max(widest, Real(kNarrowRamp)) / flat;
}

// Turns a pixel's steps to the right and up, which are at right angles to the ray, along a flat
// cell, as the way through it moves from pixel to pixel: at right angles to the ray where such
// cells are cubes. Lengths are of the cell, or shares of a tetrahedron's corners, a unit of depth;
// `depth` is the cell's. Returns how flat it is, from 0, where nothing turns, to 1.
template <typename Vec>
double alongCell(const Vec& ray, double depth, Vec& right, Vec& up) {
    double widest = 0;
    for (int a = 0; a < Vec::length(); ++a)
        widest = std::max({widest, double{std::abs(right[a])}, double{std::abs(up[a])}});
    if (!(depth * widest > kOrdinaryStep)) return 0;
    const double flat =
        std::min((depth * widest - kOrdinaryStep) / (kFlatStep - kOrdinaryStep), 1.0);
    double square = 0, ofRight = 0, ofUp = 0;
    for (int a = 0; a < Vec::length(); ++a) {
        const double r = ray[a];
        square += r * r;
        ofRight += r * right[a];
        ofUp += r * up[a];
    }
    if (!(square > 0)) return 0;
    using Real = typename Vec::value_type;
    for (int a = 0; a < Vec::length(); ++a) {
        right[a] = static_cast<Real>(right[a] - flat * (ofRight / square) * ray[a]);
        up[a] = static_cast<Real>(up[a] - flat * (ofUp / square) * ray[a]);
    }
    return flat;
}

// Of a range that is so wide for what a pixel sees of the field, how far a piece's own mean tells
// what the pixel sees of it there: of a thin one it sees all, whatever of it lies in this cell.
template <typename Real>
Real seenApart(Real widths) {
    return std::clamp(2 * widths - Real(0.5), Real(0), Real(1));
}

// Of a linear piece that is worth so much W, from value to value, over a pixel in which the field
// changes by `width`: what lies in the range, and the mean of what the pixel sees of it. Above an
// end e the values that it sees are e + width Q(x) in the mean, x being the ramp's.
template <typename Real, template <typename> typename Splat>
CellFragment<Real> withinRange(const Splat<Real>& s, Real begin, Real end, Real width,
                               Real length) {
    const auto mean = [&](Real bound) {
        const auto onRamp = [&](Real v) { return (v - bound) / width + Real(0.5); };
        return meanRamp(onRamp(begin), onRamp(end));
    };
    const auto above = [&](Real bound) {
        const auto onRamp = [&](Real v) { return (v - bound) / width + Real(0.5); };
        return width * meanAboveRamp(onRamp(begin), onRamp(end));
    };
    const Real beyond = s.crossesMost ? mean(s.most) : Real(0);
    const Real share = (s.crossesLeast ? mean(s.least) : Real(1)) - beyond;
    if (!(share > 0)) return {0, (begin + end) / 2};
    const Real least = s.crossesLeast ? s.least : Real(-1), most = s.crossesMost ? s.most : Real(1);
    const Real sum = (s.crossesLeast ? above(least) : (begin + end) / 2 - least) -
                     (s.crossesMost ? above(most) + (most - least) * beyond : Real(0));
    Real value = least + sum / share;
    if (s.crossesLeast && s.crossesMost) {
        const Real middle = (least + most) / 2;
        value = middle + seenApart((most - least) / width) * (value - middle);
    }
    return {share * length, std::clamp(value, std::max(least, Real(-1)), std::min(most, Real(1)))};
}

}  // namespace cell

template <typename Real>
CellSplat<Real> cellSplatAt(const PointsView& view, const ValuedCell& cell) {
    using Vec2 = glm::vec<2, Real>;
    using Vec3 = glm::vec<3, Real>;
    CellSplat<Real> s;
    const PixelRays& rays = view.rays;
    const glm::dvec3 size = cell.to - cell.from, middle = 0.5 * (cell.from + cell.to);
    const glm::dvec3 seen(view.viewFromAxes * glm::dvec4(middle, 1.0));
    std::array<Vec3, 3> half;  // edges, as the view sees them
    for (int a = 0; a < 3; ++a)
        half[static_cast<std::size_t>(a)] = Vec3(0.5 * size[a] * glm::dvec3(view.viewFromAxes[a]));
    const double depth = -seen.z;
    const auto deep =
        static_cast<double>(std::abs(half[0].z) + std::abs(half[1].z) + std::abs(half[2].z));
    if (!(depth + deep > rays.near)) return s;
    s.visible = cell::seeField(s, cell, view.unitLength);
    if (!s.visible) return s;
    s.perSize = Vec3(1.0 / size);
    if (depth - deep > rays.near) {
        constexpr Real kMore = Real(0.01);  // than arithmetic loses
        const Vec2 focal(rays.focal), at(seen);
        s.base = static_cast<Real>(depth);
        s.centre = rays.focal * glm::dvec2(seen) / depth;
        const Vec2 centre(s.centre);
        Vec2 least(std::numeric_limits<Real>::max()), most = -least;
        for (unsigned c = 0; c < 8; ++c) {
            Vec3 v(at, s.base);
            for (unsigned a = 0; a < 3; ++a) {
                const Vec3& edge = half[a];
                const Real side = c >> a & 1 ? Real(1) : Real(-1);
                v += side * Vec3(edge.x, edge.y, -edge.z);
            }
            const Vec2 offset = focal * Vec2(v) / v.z - centre;
            least = glm::min(least, offset);
            most = glm::max(most, offset);
        }
        s.lo = least - kMore;
        s.hi = most + kMore;
    } else {
        s.at = Vec3((rays.eye - middle) / size);
        SeenBounds bounds(rays);
        const auto cornerOf = [&](unsigned c) {
            glm::dvec3 v = seen;
            for (unsigned a = 0; a < 3; ++a)
                v += (c >> a & 1 ? 0.5 : -0.5) * size[static_cast<int>(a)] *
                     glm::dvec3(view.viewFromAxes[static_cast<int>(a)]);
            return v;
        };
        for (unsigned c = 0; c < 8; ++c)
            for (unsigned a = 0; a < 3; ++a)
                if ((c >> a & 1) == 0) bounds.take(cornerOf(c), cornerOf(c | 1u << a));
        s.lo = inFloats<Real>(bounds.lo());
        s.hi = inFloats<Real>(bounds.hi());
    }
    s.ray = Vec3(rays.along(s.centre) / size);
    s.right = Vec3(rays.perPixelX / size);
    s.up = Vec3(rays.perPixelY / size);
    const double flat = cell::alongCell(s.ray, static_cast<double>(s.base), s.right, s.up);
    s.widest = cell::widestRamp(s, s.crossesLeast, s.crossesMost, static_cast<Real>(flat));
    return s;
}

// On the ray of a pixel, `offset` pixels from the cell's centre, as far as view depth `opaque`.
template <typename Real>
CellFragment<Real> fragmentOn(const PointsView& view, const CellSplat<Real>& s,
                              const glm::vec<2, Real>& offset, Real opaque) {
    using Vec2 = glm::vec<2, Real>;
    using Vec3 = glm::vec<3, Real>;
    const PixelRays& rays = view.rays;
    const Vec3 x = Vec3(rays.perPixelX) * s.perSize, y = Vec3(rays.perPixelY) * s.perSize;
    const Vec3 shift = offset.x * x + offset.y * y;
    const Vec3 at = s.at + s.base * shift, along = s.ray + shift;
    Real from = static_cast<Real>(rays.near) - s.base, to = opaque - s.base;
    for (int a = 0; a < 3; ++a) {
        const Real step = std::copysign(std::max(std::abs(along[a]), Real(kLeastStep)), along[a]);
        const Real middle = -at[a] / step, half = std::abs(Real(0.5) / step);
        from = std::max(from, middle - half);
        to = std::min(to, middle + half);
    }
    if (!(to > from)) return {};
    const Vec2 slope = (offset + Vec2(s.centre)) / Vec2(rays.focal);
    const Real whole = static_cast<Real>(view.rayLength / view.unitLength) * (to - from) *
                       std::sqrt(1 + glm::dot(slope, slope));
    // The field's derivatives in the middle, and along the ray from there.
    const Real depth = (from + to) / 2, half = (to - from) / 2;
    const Vec3 m = at + depth * along, d = along;
    const auto& f = s.f;
    const Vec3 mixed(f[6] + f[7] * m.x, f[5] + f[7] * m.y, f[4] + f[7] * m.z);  // vw, uw, uv
    const Vec3 gradient(f[1] + f[5] * m.z + mixed.z * m.y, f[2] + f[6] * m.z + mixed.z * m.x,
                        f[3] + f[6] * m.y + mixed.y * m.x);
    const Real value = f[0] + f[1] * m.x + m.y * (f[2] + f[4] * m.x) + m.z * gradient.z;
    if (!s.crossesLeast && !s.crossesMost) return {whole, value};
    const Real first = glm::dot(gradient, d);
    const Real second = d.x * d.y * mixed.z + d.z * (d.x * mixed.y + d.y * mixed.x);
    const Real third = d.x * d.y * d.z * f[7];
    std::array<Real, kPieces + 1> values;
    for (std::size_t k = 0; k <= kPieces; ++k) {
        const Real way = half * (Real(2 * k) / kPieces - 1);
        values[k] = value + way * (first + way * (second + way * third));
    }
    const Vec2 across =
        (s.base + depth) * Vec2(glm::dot(gradient, s.right), glm::dot(gradient, s.up));
    const Real width = std::clamp(glm::length(across), Real(2 * kLeastChange), s.widest);
    Real weight = 0, sum = 0;
    for (std::size_t k = 0; k < kPieces; ++k) {
        const Real begin = values[k], end = values[k + 1];
        const CellFragment<Real> piece = cell::withinRange(
            s, begin, end, width, std::max(whole / kPieces, std::abs(end - begin) * s.perRange));
        weight += piece.weight;
        sum += piece.weight * piece.value;
    }
    if (!(weight > 0)) return {};
    return {weight, sum / weight};
}

}  // namespace render
