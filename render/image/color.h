// Linear light and its sRGB encoding (IEC 61966-2-1). Colour is linear and premultiplied everywhere
// inside render/; only the last write to an 8-bit picture encodes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace render {

double srgbFromLinear(double linear);  // [0, 1] each; not clamped outside
double linearFromSrgb(double encoded);
glm::dvec3 linearFromSrgb(glm::dvec3 encoded);
glm::dvec3 linearFromSrgb8(int red, int green, int blue);  // 0 to 255

// The light from which each of the 256 encoded steps but the first is the nearest.
const std::array<double, 255>& srgb8Steps();
// The nearest of the 256 encoded steps; clamped, NaN is 0.
std::uint8_t srgb8FromLinear(double linear);

}  // namespace render
