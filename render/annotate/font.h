// Text in pictures: labels, units, colour bars. Glyphs come from Dear ImGui's font atlas, made
// without an ImGui context; the font (Inter) is inside the program, so a picture is the same on
// every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "render/image/image.h"

namespace render {

enum class FontWeight { Regular, SemiBold };

// The file as ImGui or any other reader of OpenType takes it.
std::span<const std::byte> fontFile(FontWeight);

struct FontStyle {
    FontWeight weight = FontWeight::Regular;
    int linePixels = 20;  // from one baseline to the next; capitals are 0.60 of it, x is 0.45

    bool operator==(const FontStyle&) const = default;
};

// A glyph copied 1:1 from the atlas: picture pixel topLeft + i is atlas texel `texel` + i. Whole
// pixels only, so it needs no filtering (texelFetch, GL_NEAREST) and is as crisp as its
// rasterisation.
struct GlyphQuad {
    glm::ivec2 topLeft, size;  // picture pixels, y down
    glm::ivec2 texel;
};

// Text is UTF-8; '\n' starts a line. Malformed bytes and characters outside Latin-1, Greek, general
// punctuation, super- and subscripts and common mathematical signs are drawn as '?'. Digits have
// equal widths, so that a running number does not tremble. No kerning. Immutable.
class Font {
 public:
    // REQUIRES: linePixels >= 4.
    explicit Font(std::span<const FontStyle>);

    // REQUIRES of both: a style given to the constructor. topLeft is rounded to whole pixels.
    std::vector<GlyphQuad> layout(std::string_view text, FontStyle, glm::vec2 topLeft) const;
    glm::vec2 measure(std::string_view text, FontStyle) const;  // widest line, lines x linePixels

    glm::ivec2 atlasSize() const { return atlasSize_; }
    std::span<const std::uint8_t> atlas() const {
        return atlas_;
    }  // coverage, [y][x], top row first

 private:
    struct Glyph {
        float advance;
        glm::ivec2 offset, size, texel;  // offset from the pen at the top of the line
    };
    struct Face {
        FontStyle style;
        std::map<char32_t, Glyph> glyphs;
    };
    static void equaliseDigits(std::map<char32_t, Glyph>&);
    const Face& face(FontStyle) const;

    glm::ivec2 atlasSize_{0};
    std::vector<std::uint8_t> atlas_;
    std::vector<Face> faces_;
};

// How much of a pixel to paint for an atlas value in [0, 1]. Blended in linear light, dark strokes
// on a light ground look thinner than light ones on a dark ground; partly covered pixels of dark
// text are therefore filled more. `luminance` is that of the text, linear and straight, in [0, 1].
float textCoverage(float atlasValue, float luminance);

// Blends text over a picture in linear light, with textCoverage(). `color` is linear premultiplied;
// what lies outside the picture is cut.
void draw(Image&, const Font&, std::span<const GlyphQuad>, glm::vec4 color);

}  // namespace render
