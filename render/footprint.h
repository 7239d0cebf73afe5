// The footprint of one splat in one view, exact for any frustum. The GL shaders splat.vert and
// splat.frag compute the same in float; here the arithmetic type is a parameter.
//
// A point stands for a cell of volume V. Its mass is spread over the ellipsoid with semi-axes a
// along the lattice's axes by the density C (1 - r^2)^3.5 of the kernel-space radius r, whose line
// integrals are C' (1 - b^2)^4, b being the line's distance from the centre in kernel space
// (Crawfis and Max 1993 draw such line integrals as textures). Total mass V gives, for a ray along
// d,
//   W = V / (l a1 a2 a3) * 5 / pi * (1 - b^2)^4 * |d| / |d / a|.
// With c and d the rays of the centre and of the pixel at unit depth and z the centre's depth,
//   b^2 = z^2 |c/a x (d - c)/a|^2 / |d/a|^2,
// which cancels nowhere: d - c is linear in the offset of the pixel from the centre. Rays and
// semi-axes are in axis coordinates (render/lattice.h), where the lattice may be oblique; V, l and
// the |d| above the line are lengths in the world. V and a1 a2 a3 shrink alike when the axes lean
// over, so that V / a1 a2 a3 needs the sides of the cell only.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>

#include "render/scene.h"
#include "render/view.h"

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

template <typename Real>
struct Splat {
    using Vec2 = glm::vec<2, Real>;
    bool visible = false;  // false when its centre is nearer than the near plane
    Real depth{};          // view depth of the centre
    Vec2 centre{};         // offset from the view axis, in pixels
    Real extent{};         // half the side of a square about the centre that holds the footprint
    // At offset o from the centre: q = n(o) / d(o), W = weight |ray| (1 - q)^4 / sqrt(d(o)), with
    // n = n.x ox^2 + n.y ox oy + n.z oy^2 and d = 1 + l.ox + l.oy + the same form of d.
    glm::vec<3, Real> n{}, d{};
    Vec2 l{};
    Real weight{};

    Real denominator(const Vec2& o) const {
        return 1 + l.x * o.x + l.y * o.y + d.x * o.x * o.x + d.y * o.x * o.y + d.z * o.y * o.y;
    }
    Real numerator(const Vec2& o) const {
        return n.x * o.x * o.x + n.y * o.x * o.y + n.z * o.y * o.y;
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
    return s.weight * rayUnit * std::sqrt(ray2 / d) * u * u;
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

// Point splats are squares of whole pixels, so that each deposits exactly its mass. The first pixel
// of a square about window position w is floor(w - (side - 1) / 2), in x and in y.
inline int pointSide(const Footprint& footprint) {
    return std::max(1, static_cast<int>(std::lround(footprint.size)));
}

// Pixels first to last - 1, along one side of a picture.
struct PixelSpan {
    int first = 0, last = 0;
};
// Those whose centres, at .5, a splat at this window position may reach, of a side so many pixels
// long.
template <typename Real>
PixelSpan pixelSpan(Real window, Real extent, Kernel kernel, int length) {
    Real first = std::ceil(window - extent - Real(0.5));
    Real last = std::ceil(window + extent - Real(0.5));
    if (kernel == Kernel::Point) {
        first = std::floor(window - extent + Real(0.5));
        last = first + 2 * extent;
    }
    const auto limit = static_cast<Real>(length);
    return {static_cast<int>(std::clamp<Real>(first, 0, limit)),
            static_cast<int>(std::clamp<Real>(last, 0, limit))};
}

// A view of a lattice's points.
struct LatticeView {
    LatticeView(const Lattice& lattice, const View& view)
        : rays(pixelRays(lattice.inAxes(view))),
          viewFromWorld(view.viewFromWorld),
          rayLength(1 / glm::length(glm::dvec3(view.viewFromWorld[0]))),
          pixelArea(rayLength * rayLength / (rays.focal.x * rays.focal.y)),
          unitLength(lattice.unitLength()),
          cellVolume(std::abs(glm::determinant(lattice.worldFromAxes()))),
          lengthening(lattice.lengthening()),
          smallestRadius(kSmallestRadiusPixels * rayLength /
                         (std::min(rays.focal.x, rays.focal.y) * lengthening.least)) {}

    PixelRays rays;  // in axis coordinates
    glm::dmat4 viewFromWorld;
    double rayLength;   // of rays.axis, in the world
    double pixelArea;   // at unit depth, in the world
    double unitLength;  // l
    double cellVolume;  // of a cell whose sides are 1
    Lattice::Lengthening lengthening;
    // At unit depth, in axis coordinates: however the axes lean, no radius in the world is then
    // smaller in pixels than it may be.
    double smallestRadius;
};

template <typename Real>
Splat<Real> splatAt(const LatticeView& view, const glm::dvec3& world, const glm::dvec3& cell,
                    const Footprint& footprint) {
    using Vec3 = glm::vec<3, Real>;
    Splat<Real> s;
    const PixelRays& rays = view.rays;
    const Vec3 inView = glm::vec<3, Real>(view.viewFromWorld * glm::dvec4(world, 1.0));
    s.depth = -inView.z;
    const Real near = static_cast<Real>(rays.near);
    if (!(s.depth > near)) return s;
    s.visible = true;
    const glm::vec<2, Real> focal(rays.focal);
    s.centre = focal * glm::vec<2, Real>(inView) / s.depth;
    const Vec3 X(rays.perPixelX), Y(rays.perPixelY);
    const Vec3 C = Vec3(rays.axis) + s.centre.x * X + s.centre.y * Y;
    const Real sides = static_cast<Real>(cell.x * cell.y * cell.z / view.unitLength);
    if (footprint.kernel == Kernel::Point) {
        // The whole mass on `side`^2 pixels, seen at the ray's slant.
        const Real side = static_cast<Real>(pointSide(footprint));
        s.extent = side / 2;
        s.weight =
            sides * static_cast<Real>(view.cellVolume) * nearFade(s.depth, near) /
            (s.depth * s.depth * static_cast<Real>(view.pixelArea * view.rayLength) * side * side);
        return s;
    }
    const Vec3 a = glm::max(Vec3(cell) * static_cast<Real>(footprint.size * kQuarticRadius),
                            Vec3(s.depth * static_cast<Real>(view.smallestRadius)));
    const Vec3 c = C / a, x = X / a, y = Y / a;
    const Vec3 e = glm::cross(c, x), f = glm::cross(c, y);
    const Real perC2 = 1 / glm::dot(c, c);
    s.n = s.depth * s.depth * perC2 * Vec3(glm::dot(e, e), 2 * glm::dot(e, f), glm::dot(f, f));
    s.d = perC2 * Vec3(glm::dot(x, x), 2 * glm::dot(x, y), glm::dot(y, y));
    s.l = 2 * perC2 * glm::vec<2, Real>(glm::dot(c, x), glm::dot(c, y));
    s.weight = static_cast<Real>(5 / std::numbers::pi) * sides / (a.x * a.y * a.z) *
               std::sqrt(perC2) * nearFade(s.depth, near);
    const Real largest =
        std::max({a.x, a.y, a.z}) * static_cast<Real>(view.lengthening.most / view.rayLength);
    const Real extent = sphereExtent(s.depth, largest, glm::length(s.centre / focal));
    s.extent =
        extent < 0 ? std::numeric_limits<Real>::infinity() : extent * std::max(focal.x, focal.y);
    return s;
}

}  // namespace render
