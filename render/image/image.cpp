#include "render/image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace render {

Image::Image(glm::ivec2 pixelSize, glm::vec4 fill)
    : size(pixelSize),
      pixels(static_cast<std::size_t>(pixelSize.x) * static_cast<std::size_t>(pixelSize.y), fill) {
    assert(pixelSize.x >= 0 && pixelSize.y >= 0);
}

Image sideBySide(const Image& left, const Image& right) {
    assert(left.size == right.size);
    Image both;
    both.size = {left.size.x * 2, left.size.y};
    both.pixels.reserve(left.pixels.size() * 2);
    for (int y = 0; y < left.size.y; ++y) {
        for (const Image* eye : {&left, &right}) {
            const auto row = eye->pixels.begin() + std::ptrdiff_t{y} * eye->size.x;
            both.pixels.insert(both.pixels.end(), row, row + eye->size.x);
        }
    }
    return both;
}

Image topBottom(const Image& top, const Image& bottom) {
    assert(top.size == bottom.size);
    Image both = top;
    both.size.y *= 2;
    both.pixels.insert(both.pixels.end(), bottom.pixels.begin(), bottom.pixels.end());
    return both;
}

bool isMetadataKey(const std::string& key) {
    if (key.empty() || key.size() > 79 || key.front() == ' ' || key.back() == ' ') return false;
    if (key.find("  ") != std::string::npos) return false;
    return std::all_of(key.begin(), key.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

ImageError::ImageError(const std::filesystem::path& file, const std::string& what)
    : std::runtime_error(fmt::format("{}: {}", file.string(), what)) {}

}  // namespace render
