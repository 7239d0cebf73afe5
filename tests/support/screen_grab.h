// What an X display shows, as pixels.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace tests {

struct ScreenGrab {
    glm::ivec2 size{0};
    std::vector<glm::u8vec3> pixels;  // [y][x], from the top
};

// The whole screen of $DISPLAY. Throws std::runtime_error where there is none.
ScreenGrab grabScreen();

}  // namespace tests
