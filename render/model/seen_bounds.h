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
        takePlace(a);
        takePlace(b);
        takePassage(a, b);
    }
    // All that lies between places.
    void takeHull(std::span<const glm::dvec3> places) {
        const auto inFront = std::ranges::count_if(places, [&](auto& p) { return isInFront(p); });
        for (const glm::dvec3& place : places) takePlace(place);
        if (static_cast<std::size_t>(inFront) == places.size()) return;
        for (std::size_t i = 0; i < places.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) takePassage(places[i], places[k]);
    }

    // Pixels to the right and up of the view axis, a little more than arithmetic loses, that in
    // float, too; hi < lo where nothing is in front.
    glm::dvec2 lo() const { return lo_ - more(); }
    glm::dvec2 hi() const { return hi_ + more(); }

 private:
    static constexpr double kFar = std::numeric_limits<double>::max();

    bool isInFront(const glm::dvec3& place) const { return -place.z > near_; }
    void takePlace(const glm::dvec3& place) {
        if (isInFront(place)) takeOffset(glm::dvec2(place) / -place.z);
    }
    // Where a line passes the near plane, if it does.
    void takePassage(const glm::dvec3& a, const glm::dvec3& b) {
        if (isInFront(a) == isInFront(b)) return;
        takeOffset(glm::dvec2(glm::mix(a, b, (near_ + a.z) / (a.z - b.z))) / near_);
    }
    void takeOffset(const glm::dvec2& slope) {
        lo_ = glm::min(lo_, focal_ * slope);
        hi_ = glm::max(hi_, focal_ * slope);
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
