#include "render/image/color.h"

#include <algorithm>
#include <cmath>

namespace render {

double srgbFromLinear(double linear) {
    if (linear <= 0.0031308) return 12.92 * linear;
    return 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linearFromSrgb(double encoded) {
    if (encoded <= 0.04045) return encoded / 12.92;
    return std::pow((encoded + 0.055) / 1.055, 2.4);
}

glm::dvec3 linearFromSrgb(glm::dvec3 encoded) {
    return {linearFromSrgb(encoded.r), linearFromSrgb(encoded.g), linearFromSrgb(encoded.b)};
}

glm::dvec3 linearFromSrgb8(int red, int green, int blue) {
    return linearFromSrgb(glm::dvec3(red, green, blue) / 255.0);
}

const std::array<double, 255>& srgb8Steps() {
    static const auto steps = [] {
        std::array<double, 255> bounds{};
        for (std::size_t step = 0; step < bounds.size(); ++step)
            bounds[step] = linearFromSrgb((static_cast<double>(step) + 0.5) / 255);
        return bounds;
    }();
    return steps;
}

std::uint8_t srgb8FromLinear(double linear) {
    // The encoding is monotone, so the nearest step is found among the light values where the
    // rounding changes: 8 comparisons in place of a pow.
    if (std::isnan(linear)) return 0;
    const auto& steps = srgb8Steps();
    return static_cast<std::uint8_t>(std::upper_bound(steps.begin(), steps.end(), linear) -
                                     steps.begin());
}

}  // namespace render
