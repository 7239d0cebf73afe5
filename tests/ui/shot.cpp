#include "tests/ui/shot.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <glm/common.hpp>

#include "render/image/color.h"
#include "render/image/png.h"

namespace ui {

Shot part(const Shot& shot, const app::panels::Rect& place) {
    const glm::ivec2 from = glm::max(glm::ivec2(place.min), glm::ivec2(0)),
                     to = glm::min(glm::ivec2(place.max), shot.size);
    Shot out{.size = glm::max(to - from, glm::ivec2(0)), .pixels = {}};
    for (int y = from.y; y < to.y; ++y)
        for (int x = from.x; x < to.x; ++x) out.pixels.push_back(shot.at({x, y}));
    return out;
}

std::size_t differing(const Shot& a, const Shot& b) {
    assert(a.size == b.size);
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1 : 0;
    return count;
}

int greatestDifference(const Shot& a, const Shot& b) {
    assert(a.size == b.size);
    int greatest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (std::size_t c = 0; c < a.pixels[i].size(); ++c)
            greatest = std::max(greatest, std::abs(a.pixels[i][c] - b.pixels[i][c]));
    return greatest;
}

Shot readShot(const std::filesystem::path& png) {
    const render::Image image = render::readPng(png).image;
    Shot out{.size = image.size, .pixels = {}};
    for (const glm::vec4& light : image.pixels) {
        Shot::Pixel pixel{};
        for (int i = 0; i < 3; ++i)
            pixel[static_cast<std::size_t>(i)] =
                render::srgb8FromLinear(static_cast<double>(light[i]));
        out.pixels.push_back(pixel);
    }
    return out;
}

void writeShot(const std::filesystem::path& png, const Shot& shot) {
    render::Image image(shot.size, glm::vec4(0, 0, 0, 1));
    for (std::size_t i = 0; i < shot.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            image.pixels[i][c] = static_cast<float>(
                render::linearFromSrgb(shot.pixels[i][static_cast<std::size_t>(c)] / 255.0));
    render::writePng(png, image);
}

}  // namespace ui
