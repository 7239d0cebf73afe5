// Linear light to sRGB bytes, many at once, on the processor. Pure.
#pragma once

#include <cstdint>
#include <span>

namespace render {

// The bytes of srgb8FromLinear (render/image/color.h), but for light within 0.001 steps of the
// border between two, which may become either. What is no light, NaN too, becomes 0; what is more
// than 1, 255. REQUIRES: spans of one length.
void encodeSrgb8(std::span<const float> linear, std::span<std::uint8_t> bytes);

}  // namespace render
