// The footprint of one splat in one view, exact for any frustum. The GL shaders splat.vert and
// splat.frag compute the same in float; here the arithmetic type is a parameter.
//
// A point stands for a cell of volume V. Its mass is spread over the ellipsoid with semi-axes a
// along the grid's axes by the density C (1 - r^2)^3.5 of the kernel-space radius r, whose line
// integrals are C' (1 - b^2)^4, b being the line's distance from the centre in kernel space
// (Crawfis and Max 1993 draw such line integrals as textures). Total mass V gives, for a ray along
// d,
//   W = V / (l a1 a2 a3) * 5 / pi * (1 - b^2)^4 * |d| / |d / a|.
// With c and d the rays of the centre and of the pixel at unit depth and z the centre's depth,
//   b^2 = z^2 |c/a x (d - c)/a|^2 / |d/a|^2,
// which cancels nowhere: d - c is linear in the offset of the pixel from the centre. Rays and
// semi-axes are in axis coordinates (render/points/placed_points.h), where the grid may be oblique;
// V, l and the |d| above the line are lengths in the world. V and a1 a2 a3 shrink alike when the
// axes lean over, so that V / a1 a2 a3 needs the sides of the cell only.
//
// A point of a mesh stands for the cell whose sides are the columns of any matrix J. Its ellipsoid
// is where |L^-1 v| <= 1, L L^T = (s R)^2 J J^T, with the triangular L that has the diagonal a:
// division by a becomes forward substitution, and a1 a2 a3 is det L. Where such an ellipsoid is
// thinner than the least radius r, L L^T + g I stands in its place (Zwicker et al., "EWA
// splatting", 2002), g being what keeps all of its semi-axes at r, or little more.
//
// Where cells are much longer than wide (PlacedPoints::longCells) such a splat would reach far out
// of the domain: there it ends at the faces of the box that the cells fill, which stand half a cell
// before the outermost points, or the least radius of a splat where that is more. A ray takes what
// it passes inside: W times the share of (1 - b^2 - s^2)^3.5 between the lengths s at which it
// enters and leaves. What is cut off goes to the rest, by a factor: each pair of faces leaves a
// share of the density's integral over planes, (1 - t^2)^4.5, and the three shares are multiplied.
// Columns of a mesh with few levels (a cell reaches over a tenth of them) end so above and below.
// That is exact beside one face; along edges and at corners of the domain see
// tests/render/footprint_test.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>

#include "render/model/ellipsoid.h"
#include "render/model/scene.h"
#include "render/points/view.h"

namespace render {

// The first zero of J5 over 2 pi: the Fourier transform of (1 - q)^4 then vanishes at the lattice's
// first harmonic, so a uniform slab is drawn flat to 0.5 %.
inline constexpr double kQuarticRadius = 8.771483815959954 / (2 * std::numbers::pi);
// Semi-axes are no smaller than this many pixels, for the same reason: the pixels are a lattice
// too.
inline constexpr double kSmallestRadiusPixels = kQuarticRadius;
// Of d(o) below. Where a pixel's ray passes through the footprint, d is about (z / (z + a))^2 or
// more, a being the largest semi-axis; less is what float's cancellation leaves of 0, of either
// sign, on rays far beside a flat cell that is near the eye.
inline constexpr float kLeastDenominator = 1e-6f;

// Odd polynomials in u^2 that are 1 at u = 1: the integrals of (1 - t^2)^3.5 and of (1 - t^2)^4.5
// from 0 to u over those to 1, interpolated at Chebyshev's points, to 1.4e-6 and 1e-6.
inline constexpr std::array kAlongRay{
    2.328209850438002,   -2.7162830651268592,   2.0377843444782133,  -0.7309657629739267,
    0.07952103922902895, -0.005041042897576919, 0.006774636853110604};
inline constexpr std::array kAcrossPlanes{
    2.5868989965218416, -3.8803104512271367,  4.073761886268686,    -2.421745329506627,
    0.6981470154212479, -0.04600672580023147, -0.010745391677797065};
template <typename Real>
Real oddPolynomial(const std::array<double, 7>& coefficients, Real u) {
    Real sum = 0;
    for (int k = 6; k >= 0; --k) sum = sum * u * u + static_cast<Real>(coefficients[k]);
    return sum * u;
}
// Of the whole, between two lengths in units of half the whole; beyond -1 and 1 there is nothing.
template <typename Real>
Real shareBetween(const std::array<double, 7>& coefficients, Real from, Real to) {
    return (oddPolynomial(coefficients, std::clamp<Real>(to, -1, 1)) -
            oddPolynomial(coefficients, std::clamp<Real>(from, -1, 1))) /
           2;
}

template <typename Real>
struct Splat {
    using Vec2 = glm::vec<2, Real>;
    using Vec3 = glm::vec<3, Real>;
    bool visible = false;  // false when its centre is nearer than the near plane
    bool cut = false;      // by a face of the domain
    Real depth{};          // view depth of the centre
    Vec2 centre{};         // offset from the view axis, in pixels
    Vec2 lo{}, hi{};       // offsets from the centre between which the footprint lies
    // At offset o from the centre: q = n(o) / d(o), W = weight |ray| (1 - q)^4 / sqrt(d(o)), with
    // n = n.x ox^2 + n.y ox oy + n.z oy^2 and d = 1 + l.ox + l.oy + the same form of d.
    glm::vec<3, Real> n{}, d{};
    Vec2 l{};
    Real weight{};
    // Of a cut one, in kernel space: the ray of the centre at unit depth, what a pixel adds to it,
    // and the faces as the centre sees them.
    Vec3 c{}, x{}, y{}, loFace{}, hiFace{};

    Real denominator(const Vec2& o) const {
        return 1 + l.x * o.x + l.y * o.y + d.x * o.x * o.x + d.y * o.x * o.y + d.z * o.y * o.y;
    }
    Real numerator(const Vec2& o) const {
        return n.x * o.x * o.x + n.y * o.x * o.y + n.z * o.y * o.y;
    }
    // The share of what the ray at offset o would take that lies inside the domain. With d the ray
    // and c that of the centre, in kernel space, and h = depth * (d - c), which o is linear in, the
    // ray is nearest to the centre at -h.d / d.d beyond the centre's depth. REQUIRES: cut, q < 1.
    Real insideShare(const Vec2& o, Real q) const {
        constexpr Real kLeast = Real(1e-20);  // so that a ray along a face divides by something
        Real from = -std::numeric_limits<Real>::max(), to = std::numeric_limits<Real>::max();
        Real dd = 0, hd = 0;
        for (int a = 0; a < 3; ++a) {
            const Real h = depth * (o.x * x[a] + o.y * y[a]);
            const Real along = c[a] + o.x * x[a] + o.y * y[a];
            dd += along * along;
            hd += h * along;
            const Real per = 1 / (std::abs(along) < kLeast ? kLeast : along);
            const Real one = (loFace[a] - h) * per, other = (hiFace[a] - h) * per;
            from = std::max(from, std::min(one, other));
            to = std::min(to, std::max(one, other));
        }
        const Real nearest = -hd / dd, perHalf = std::sqrt(dd / (1 - q));
        return shareBetween(kAlongRay, (from - nearest) * perHalf,
                            std::max(to - nearest, from - nearest) * perHalf);
    }
};

// W on the ray of a pixel, `offset` pixels from the splat's centre and of this x / -z and y / -z;
// none beside the footprint. Of a point splat, on any pixel of its square. `rayUnit` is the length
// of the ray of the view axis.
template <typename Real>
std::optional<Real> weightOn(const Splat<Real>& s, Kernel kernel, const glm::vec<2, Real>& offset,
                             const glm::vec<2, Real>& slope, Real rayUnit) {
    const Real ray2 = 1 + glm::dot(slope, slope);
    if (kernel == Kernel::Point) return s.weight * rayUnit * std::sqrt(ray2);
    const Real d = s.denominator(offset);
    const Real q = s.numerator(offset) / d;
    if (q >= 1 || !(d > Real(kLeastDenominator))) return std::nullopt;
    const Real u = (1 - q) * (1 - q);
    const Real whole = s.weight * rayUnit * std::sqrt(ray2 / d) * u * u;
    if (!s.cut) return whole;
    const Real share = s.insideShare(offset, q);
    return share > 0 ? std::optional(whole * share) : std::nullopt;
}

// Half the side of the square about a sphere's projected centre that holds its outline, on the
// plane at unit depth: the outline reaches farthest outward, from angle theta to theta + phi.
// Returns a negative number when the outline reaches behind the eye.
template <typename Real>
Real sphereExtent(Real depth, Real radius, Real tanTheta) {
    const Real cosTheta = 1 / std::sqrt(1 + tanTheta * tanTheta);
    const Real sinPhi = radius / depth * cosTheta;
    if (sinPhi >= 1) return -1;
    const Real cosSum = cosTheta * std::sqrt(1 - sinPhi * sinPhi) - tanTheta * cosTheta * sinPhi;
    return cosSum > 0 ? sinPhi / (cosTheta * cosSum) : -1;
}

// Weight rises from 0 at the near plane to 1 at twice its distance, so that nothing pops.
template <typename Real>
Real nearFade(Real depth, Real near) {
    const Real t = std::clamp<Real>(depth / near - 1, 0, 1);
    return t * t * (3 - 2 * t);
}

// Where n - d <= 0, of a splat whose lo and hi are those of a square: narrower, if that is the
// inside of an ellipse and arithmetic tells it well.
template <typename Real>
void narrow(Splat<Real>& s) {
    constexpr Real kWell = Real(1e-4);
    const glm::vec<3, Real> m = s.n - s.d;  // m.x ox^2 + m.y ox oy + m.z oy^2 - l.o = 1
    const Real det = m.x * m.z - m.y * m.y / 4;
    if (!(m.x > kWell * s.n.x && m.z > kWell * s.n.z && det > kWell * m.x * m.z)) return;
    const glm::vec<2, Real> middle =
        glm::vec<2, Real>(m.z * s.l.x - m.y / 2 * s.l.y, m.x * s.l.y - m.y / 2 * s.l.x) / (2 * det);
    const Real level = 1 + glm::dot(s.l, middle) / 2;
    const auto half =
        glm::sqrt(level / det * glm::vec<2, Real>(m.z, m.x)) * Real(1.001) + Real(0.01);
    s.lo = glm::max(s.lo, middle - half);
    s.hi = glm::min(s.hi, middle + half);
}

// Point splats are squares of whole pixels, so that each deposits exactly its mass. The first pixel
// of a square about window position w is floor(w - (side - 1) / 2), in x and in y.
inline int pointSide(const Footprint& footprint) {
    return std::max(1, static_cast<int>(std::lround(footprint.size)));
}

// Pixels first to last - 1, along one side of a picture.
struct PixelSpan {
    int first = 0, last = 0;
};
// Those whose centres, at .5, a splat at this window position may reach with these offsets, of a
// side so many pixels long.
template <typename Real>
PixelSpan pixelSpan(Real window, Real lo, Real hi, Kernel kernel, int length) {
    Real first = std::ceil(window + lo - Real(0.5));
    Real last = std::ceil(window + hi - Real(0.5));
    if (kernel == Kernel::Point) {
        first = std::floor(window + lo + Real(0.5));
        last = first + hi - lo;
    }
    const auto limit = static_cast<Real>(length);
    return {static_cast<int>(std::clamp<Real>(first, 0, limit)),
            static_cast<int>(std::clamp<Real>(last, 0, limit))};
}

// Placed points as a view sees them.
struct PointsView {
    PointsView(const PlacedPoints& of, const View& view)
        : placed(of),
          domain(of.domain()),
          rays(pixelRays(placed.inAxes(view))),
          viewFromWorld(view.viewFromWorld),
          viewFromAxes(placed.inAxes(view).viewFromWorld),
          rayLength(1 / glm::length(glm::dvec3(view.viewFromWorld[0]))),
          pixelArea(rayLength * rayLength / (rays.focal.x * rays.focal.y)),
          unitLength(placed.unitLength()),
          cellVolume(std::abs(glm::determinant(placed.worldFromAxes()))),
          lengthening(placed.lengthening()),
          smallestRadius(kSmallestRadiusPixels * rayLength /
                         (std::min(rays.focal.x, rays.focal.y) * lengthening.least)) {}

    const PlacedPoints& placed;
    PlacedPoints::Box domain;
    PixelRays rays;  // in axis coordinates
    glm::dmat4 viewFromWorld, viewFromAxes;
    double rayLength;   // of rays.axis, in the world
    double pixelArea;   // at unit depth, in the world
    double unitLength;  // l
    double cellVolume;  // of a cell whose sides are 1
    PlacedPoints::Lengthening lengthening;
    // At unit depth, in axis coordinates: however the axes lean, no radius in the world is then
    // smaller in pixels than it may be.
    double smallestRadius;
};
// As it sees cells, and what is held against them.
struct CellsView : PointsView {
    CellsView(const PlacedPoints& of, const View& view) : PointsView(of, view) {
        rays = besideFaces(rays);
    }
};

// Semi-axes of a cell's splat; those of long cells are no longer than what they are cut to can use.
template <typename Real>
glm::vec<3, Real> radii(const PointsView& view, const glm::dvec3& cell,
                        const Footprint& footprint) {
    glm::dvec3 widths = footprint.size * cell;
    if (view.placed.longCells()) widths = glm::min(widths, view.domain.hi - view.domain.lo);
    return glm::vec<3, Real>(kQuarticRadius * widths);
}

// Ends the splat at the domain's faces, if it reaches them.
template <typename Real>
void cutAtFaces(Splat<Real>& s, const PointsView& view, const glm::dvec3& along,
                const glm::vec<3, Real>& a, Real leastRadius) {
    const glm::dvec3 least(static_cast<double>(leastRadius));
    const auto& [box, half] = std::pair(view.domain, view.placed.boxHalf());
    s.loFace = glm::vec<3, Real>(glm::min(box.lo, -half - least) - along) / a;
    s.hiFace = glm::vec<3, Real>(glm::max(box.hi, half + least) - along) / a;
    if (view.placed.isMesh())  // columns: cut above and below
        for (int k = 0; k < 2; ++k) s.loFace[k] = -2, s.hiFace[k] = 2;
    for (int k = 0; k < 3; ++k) {
        s.cut = s.cut || s.loFace[k] > -1 || s.hiFace[k] < 1;
        s.weight /= shareBetween(kAcrossPlanes, s.loFace[k], s.hiFace[k]);
    }
}

// What a splat is made of: its mass, and the ellipsoid that it fills.
template <typename Real>
struct Ellipsoid {
    double sides = 0;  // volume of the cell in axis coordinates
    timeseries::LowerTriangle<Real> factor;
    Real widest{};  // semi-axis, at most
};
template <typename Real>
Ellipsoid<Real> ellipsoidOf(const PointsView& view, std::uint64_t index, const Footprint& footprint,
                            double least) {
    Ellipsoid<Real> e;
    if (!view.placed.isMesh()) {
        const glm::dvec3 cell = view.placed.cell(index);
        e.sides = cell.x * cell.y * cell.z;
        const glm::vec<3, Real> a = glm::max(radii<Real>(view, cell, footprint),
                                             glm::vec<3, Real>(static_cast<Real>(least)));
        e.factor.diagonal = a;
        e.widest = std::max({a.x, a.y, a.z});
        return e;
    }
    const double radius = kQuarticRadius * footprint.size;
    const auto cell = view.placed.meshCell(index);
    e.sides = view.placed.mesh()->volumeOf(cell, index);
    if (!(e.sides > 0)) return e;
    e.factor = grownTo(least, cell.scaled(glm::dvec3(radius))).template as<Real>();
    const auto &a = e.factor.diagonal, &b = e.factor.below;
    e.widest = std::sqrt(glm::dot(a, a) + glm::dot(b, b));
    return e;
}

// Of the point of that grid index.
template <typename Real>
Splat<Real> splatAt(const PointsView& view, std::uint64_t index, const Footprint& footprint) {
    using Vec2 = glm::vec<2, Real>;
    using Vec3 = glm::vec<3, Real>;
    Splat<Real> s;
    const PixelRays& rays = view.rays;
    const Vec3 inView = Vec3(view.viewFromWorld * glm::dvec4(view.placed.position(index), 1.0));
    s.depth = -inView.z;
    const Real near = static_cast<Real>(rays.near);
    if (!(s.depth > near)) return s;
    const Vec2 focal(rays.focal);
    s.centre = focal * Vec2(inView) / s.depth;
    const Vec3 X(rays.perPixelX), Y(rays.perPixelY);
    const Vec3 C = Vec3(rays.axis) + s.centre.x * X + s.centre.y * Y;
    const Real least = s.depth * static_cast<Real>(view.smallestRadius);
    const auto e = ellipsoidOf<Real>(view, index, footprint, static_cast<double>(least));
    s.visible = e.sides > 0;
    if (!s.visible) return s;
    const Real sides = static_cast<Real>(e.sides / view.unitLength);
    if (footprint.kernel == Kernel::Point) {
        // The whole mass on `side`^2 pixels, seen at the ray's slant.
        const Real side = static_cast<Real>(pointSide(footprint));
        s.lo = Vec2(-side / 2);
        s.hi = Vec2(side / 2);
        s.weight =
            sides * static_cast<Real>(view.cellVolume) * nearFade(s.depth, near) /
            (s.depth * s.depth * static_cast<Real>(view.pixelArea * view.rayLength) * side * side);
        return s;
    }
    const Vec3& a = e.factor.diagonal;
    const auto inKernel = [&](const Vec3& v) {
        return view.placed.isMesh() ? e.factor.solve(v) : v / a;
    };
    s.c = inKernel(C), s.x = inKernel(X), s.y = inKernel(Y);
    const Vec3 across = glm::cross(s.c, s.x), other = glm::cross(s.c, s.y);
    const Real perC2 = 1 / glm::dot(s.c, s.c);
    s.n = s.depth * s.depth * perC2 *
          Vec3(glm::dot(across, across), 2 * glm::dot(across, other), glm::dot(other, other));
    s.d = perC2 * Vec3(glm::dot(s.x, s.x), 2 * glm::dot(s.x, s.y), glm::dot(s.y, s.y));
    s.l = 2 * perC2 * Vec2(glm::dot(s.c, s.x), glm::dot(s.c, s.y));
    s.weight = static_cast<Real>(5 / std::numbers::pi) * sides / (a.x * a.y * a.z) *
               std::sqrt(perC2) * nearFade(s.depth, near);
    const Real largest = e.widest * static_cast<Real>(view.lengthening.most / view.rayLength);
    const Real extent = sphereExtent(s.depth, largest, glm::length(s.centre / focal));
    s.hi = Vec2(extent < 0 ? std::numeric_limits<Real>::infinity()
                           : extent * std::max(focal.x, focal.y));
    s.lo = -s.hi;
    if (view.placed.isMesh() || view.placed.longCells()) narrow(s);
    if (view.placed.longCells()) cutAtFaces(s, view, view.placed.alongAxes(index), a, least);
    return s;
}

}  // namespace render
