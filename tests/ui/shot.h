// What a window shows, pixel by pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <vector>

#include "app/panels/layout.h"

namespace ui {

struct Shot {
    using Pixel = std::array<std::uint8_t, 3>;  // R, G, B

    glm::ivec2 size{0};
    std::vector<Pixel> pixels;  // [y][x], the upper row first

    const Pixel& at(glm::ivec2 place) const {
        return pixels[static_cast<std::size_t>(place.y * size.x + place.x)];
    }
    friend bool operator==(const Shot&, const Shot&) = default;
};

// The part inside; cut to the shot.
Shot part(const Shot& shot, const app::panels::Rect& place);

// How many pixels are not the same. REQUIRES: equal sizes.
std::size_t differing(const Shot& a, const Shot& b);
// The greatest difference of two bytes of one place. REQUIRES: equal sizes.
int greatestDifference(const Shot& a, const Shot& b);

// Of a PNG that the program wrote: 8 bits, as a screen shows them.
Shot readShot(const std::filesystem::path& png);
void writeShot(const std::filesystem::path& png, const Shot& shot);

}  // namespace ui
