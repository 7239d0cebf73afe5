// Pictures in memory, as every writer, reader and comparison takes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace render {

// Linear light (Rec. 709 primaries, D65), premultiplied, float RGBA. Row 0 is the TOP of the
// picture; x fastest. GL reads back bottom row first: flip there, once.
struct Image {
    Image() = default;
    // REQUIRES: size >= 0.
    explicit Image(glm::ivec2 pixelSize, glm::vec4 fill = glm::vec4(0));

    glm::vec4& at(int x, int y) { return pixels[index(x, y)]; }
    const glm::vec4& at(int x, int y) const { return pixels[index(x, y)]; }

    bool operator==(const Image&) const = default;

    glm::ivec2 size{0};
    std::vector<glm::vec4> pixels;  // [size.y][size.x]

 private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
               static_cast<std::size_t>(x);
    }
};

// Both eyes in one picture. REQUIRES: equal sizes.
Image sideBySide(const Image& left, const Image& right);
Image topBottom(const Image& top, const Image& bottom);

// Text kept with a picture: key -> UTF-8 value.
// REQUIRES of every writer: keys of 1 to 79 printable ASCII characters without a space at either
// end or two in a row (PNG 11.3.4.2), values without NUL.
using Metadata = std::map<std::string, std::string>;
bool isMetadataKey(const std::string& key);

// A picture file that cannot be read or written; one sentence that names the file.
struct ImageError : std::runtime_error {
    ImageError(const std::filesystem::path& file, const std::string& what);
};

// The largest picture a reader accepts, 4 GiB as floats: room for a 16k x 16k poster, and a limit
// to what a damaged header can make us allocate.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

}  // namespace render
