// The published colour maps as numbers; see color_map.h for their use.
#pragma once

#include <array>
#include <cstdint>

namespace render {

using EncodedTable = std::array<std::array<std::uint16_t, 3>, 256>;  // sRGB, 65535 is 1

extern const EncodedTable kViridis, kCividis, kInferno;

}  // namespace render
