// A point of a mesh as it is kept, in 24 bytes: where it lies, and the shape of its cell.
//
// Numbers are kept as small floats, which below a least power of two are evenly spaced:
//
//   of each coordinate      27 bits  sign, 4 of exponent, 22 of mantissa; all ones: no place
//   diagonal.x, diagonal.z  15 bits  7 of exponent, 8 of mantissa; zero: no cell
//   diagonal.y              28 bits  7 and 21: what makes the determinant right, whatever the
//                                    others were rounded to
//   below.x                 15 bits  sign, 5 and 9: over the diagonal element of its row
//   below.y, below.z        16 bits  sign, 5 and 10, likewise
//   turned over, widened     1 and 5 bits
//
// The determinant is right to 2^-22, so that splats draw what the cells hold; the sides are right
// to a 250th, x and z to a 500th: less than a pixel of a cell that is drawn 250 pixels wide.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

#include "timeseries/grid/lower_triangle.h"

namespace timeseries {

// How a small float is kept: its code ascends with its magnitude. Who unpacks elsewhere
// (render/splat/shaped_points-inl.h, render/shaders/splat_points.glsl) does as this says.
struct SmallFloat {
    int mantissa;  // bits of it that are kept
    int least;     // the exponent of the least power of two that is kept as others are
    int bits;      // of the code

    constexpr std::uint32_t last() const { return (std::uint32_t{1} << bits) - 1; }
    // Of the nearest magnitude there is. REQUIRES: a number, not negative.
    std::uint32_t code(double magnitude) const {
        constexpr int kDoubleMantissa = 52, kDoubleBias = 1023;
        const auto bitsOf = [](double x) { return std::bit_cast<std::uint64_t>(x); };
        const auto powerOfTwo = [](int exponent) {
            return std::bit_cast<double>(std::uint64_t(kDoubleBias + exponent) << kDoubleMantissa);
        };
        if (magnitude < powerOfTwo(least))
            return static_cast<std::uint32_t>(magnitude * powerOfTwo(mantissa - least) + 0.5);
        const int dropped = kDoubleMantissa - mantissa;
        const std::uint64_t rounded =
            (bitsOf(magnitude) + (std::uint64_t{1} << (dropped - 1))) >> dropped;
        const auto offset = static_cast<std::uint64_t>(kDoubleBias + least - 1) << mantissa;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(rounded - offset, last()));
    }
    constexpr float magnitude(std::uint32_t code) const {
        constexpr int kFloatMantissa = 23, kFloatBias = 127;
        const auto power = [](int exponent) {
            return static_cast<std::uint32_t>(kFloatBias + exponent) << kFloatMantissa;
        };
        if (code >> mantissa == 0)
            return static_cast<float>(code) * std::bit_cast<float>(power(least - mantissa));
        return std::bit_cast<float>((code << (kFloatMantissa - mantissa)) + power(least - 1));
    }
};

class ShapedPoint {
 public:
    static constexpr SmallFloat kPlace{22, -13, 26};
    static constexpr SmallFloat kSide{8, -89, 15}, kRightSide{21, -89, 28};
    static constexpr SmallFloat kFirstSlope{9, -4, 14}, kSlope{10, -4, 15};
    static constexpr int kPlaceBits = 1 + kPlace.bits;
    static constexpr std::uint32_t kNoPlace = (1u << kPlaceBits) - 1;  // of each coordinate

    ShapedPoint() = default;
    // One without a cell. What is no number is no place.
    explicit ShapedPoint(const glm::dvec3& at);
    // REQUIRES: coordinates less than 4, a diagonal > 0, widened at most kMostWidened. Of an area,
    // diagonal.x * diagonal.y is what is right.
    enum class Right { Volume, Area };
    ShapedPoint(const glm::dvec3& at, const LowerTriangle<double>& cell, bool turned,
                unsigned widened, Right right);

    glm::vec3 at() const {
        glm::vec3 place;
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t code = word[static_cast<std::size_t>(c)] & kNoPlace;
            place[c] =
                code == kNoPlace ? std::numeric_limits<float>::quiet_NaN() : signedOf(kPlace, code);
        }
        return place;
    }
    bool hasCell() const { return (word[3] & kSide.last()) != 0; }
    bool turned() const { return word[3] >> 30 & 1; }  // over
    unsigned widened() const { return word[3] >> 31 | word[4] >> kRightSide.bits << 1; }
    // Zero: none.
    LowerTriangle<float> cell() const {
        const float x = kSide.magnitude(word[3] & kSide.last());
        const float y = kRightSide.magnitude(word[4] & kRightSide.last());
        const float z = kSide.magnitude(word[3] >> kSide.bits & kSide.last());
        const std::uint32_t first =
            word[0] >> kPlaceBits | word[1] >> kPlaceBits << 5 | word[2] >> kPlaceBits << 10;
        return {{x, y, z},
                {y * signedOf(kFirstSlope, first), z * signedOf(kSlope, word[5] & 0xffff),
                 z * signedOf(kSlope, word[5] >> 16)}};
    }

    friend bool operator==(const ShapedPoint&, const ShapedPoint&) = default;

    std::array<std::uint32_t, 6> word{};

 private:
    static float signedOf(const SmallFloat& form, std::uint32_t code) {
        const auto magnitude = std::bit_cast<std::uint32_t>(form.magnitude(code & form.last()));
        return std::bit_cast<float>(magnitude | code >> form.bits << 31);
    }
};
static_assert(sizeof(ShapedPoint) == 24);

}  // namespace timeseries
