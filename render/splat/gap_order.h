// What is in front of what across gaps: of parts of a mesh that no faces join, which cell hides
// which, by what rays through a picture's pixels meet of their outer faces (Silva, Mitchell,
// Williams, "An exact interactive time visibility ordering algorithm for polyhedral cell
// complexes", 1998).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "render/points/view.h"

namespace render {

// Between convex cells that do not meet there is one order for all rays, so that a few tell it.
class GapOrder {
 public:
    // A triangle of an outer face, in axis coordinates, where the mesh's cell `cell`, any number
    // below 2^31, is entered by rays from the eye, or left.
    struct Outer {
        std::array<glm::dvec3, 3> at;
        std::uint32_t cell;
        bool isEntered;
    };
    using Pair = std::pair<std::uint32_t, std::uint32_t>;  // the one before, the one behind

    explicit GapOrder(const View& view);
    // In this order; what of them is behind the eye's near plane is left out.
    void add(std::span<const Outer> outer, unsigned threads);
    // When all are added. Rays are as many as pixels, or fewer, where they would meet too many.
    void begin();
    // Follows this share of the rays. Each ray that leaves a cell, and enters another one next,
    // tells one pair, of which some come more than once.
    void goOn(double share, unsigned threads, std::vector<Pair>& pairs);
    bool done() const { return strip_ == strips_; }

 private:
    struct Seen {
        std::array<glm::vec2, 3> at;  // window position
        std::array<double, 3> perDepth;
        std::uint32_t cell;
        bool isEntered;
    };
    struct Met {
        std::uint64_t ray;  // its number, and how near it is met, the nearer the less
        std::uint32_t cell;
        bool isEntered;
        friend auto operator<=>(const Met&, const Met&) = default;
    };
    void see(const Outer& outer, std::vector<Seen>& into) const;
    std::pair<int, int> stripsOf(const Seen& seen) const;
    void meet(const Seen& seen, int firstRow, int endRow, std::vector<Met>& met) const;
    void follow(int strip, std::vector<Pair>& pairs) const;

    View view_;
    PixelRays rays_;
    std::vector<Seen> seen_;
    double area_ = 0;  // of all, in pixels
    // Of all, 1 / depth: an eye that is very far away sees depths that floats do not tell apart.
    double least_ = std::numeric_limits<double>::infinity(), most_ = 0;
    int apart_ = 1;        // pixels from ray to ray
    glm::ivec2 count_{0};  // of rays across and up
    int strips_ = 0, strip_ = 0;
    std::vector<std::uint32_t> ends_, inStrips_;  // of each strip, its places in seen_
};

}  // namespace render
