// Where in a picture a body with flat faces lies that the eye is beside or within: its edges as far
// as they are in front of the near plane, and where they pass through that. Without it each cell
// that the near plane crosses would be asked of by every pixel, and a grid that an eye is within
// has as many of them as a layer has.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "render/points/view.h"

namespace render {

class SeenBounds {
 public:
    explicit SeenBounds(const PixelRays& rays) : near_(rays.near), focal_(rays.focal) {}

    // An edge, or any line between two of its places, in view space.
    void take(const glm::dvec3& a, const glm::dvec3& b) {
        const bool isA = -a.z > near_, isB = -b.z > near_;
        if (isA) takePlace(a, -a.z);
        if (isB) takePlace(b, -b.z);
        if (isA != isB) takePlace(glm::mix(a, b, (near_ + a.z) / (a.z - b.z)), near_);
    }
    // All that lies between places.
    void takeHull(std::span<const glm::dvec3> places) {
        for (std::size_t i = 0; i < places.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) take(places[i], places[k]);
    }

    // Pixels to the right and up of the view axis, a little more than arithmetic loses, that in
    // float, too; hi < lo where nothing is in front.
    glm::dvec2 lo() const { return lo_ - more(); }
    glm::dvec2 hi() const { return hi_ + more(); }

 private:
    static constexpr double kFar = std::numeric_limits<double>::max();

    void takePlace(const glm::dvec3& place, double depth) {
        const glm::dvec2 offset = focal_ * glm::dvec2(place) / depth;
        lo_ = glm::min(lo_, offset);
        hi_ = glm::max(hi_, offset);
    }
    glm::dvec2 more() const {
        if (lo_.x > hi_.x) return glm::dvec2(0);
        constexpr double kMore = 0.01, kOfFloats = 1e-5;
        return kMore + kOfFloats * glm::max(glm::abs(lo_), glm::abs(hi_));
    }

    double near_;
    glm::dvec2 focal_, lo_{kFar}, hi_{-kFar};
};

// As floats hold them, or doubles.
template <typename Real>
glm::vec<2, Real> inFloats(const glm::dvec2& offset) {
    constexpr double kMost = 1e30;  // beside any picture
    return glm::vec<2, Real>(glm::clamp(offset, -kMost, kMost));
}

}  // namespace render
