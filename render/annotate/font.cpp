#include "render/annotate/font.h"

#include <imgui.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>

#include "render/annotate/utf8.h"

extern "C" {
extern const unsigned char isochron_inter_regular_begin[], isochron_inter_regular_end[];
extern const unsigned char isochron_inter_semibold_begin[], isochron_inter_semibold_end[];
}

namespace render {

namespace {

// Pairs of first and last, ended by 0; ImGui skips what the font lacks.
constexpr ImWchar kGlyphRanges[] = {
    0x0020, 0x007E,  // ASCII
    0x00A0, 0x00FF,  // Latin-1: ° ± ² ³ µ · ×
    0x0370, 0x03FF,  // Greek
    0x2010, 0x205E,  // dashes, quotes, ellipsis, per mille, primes
    0x2070, 0x209C,  // super- and subscripts
    0x2190, 0x2199,  // arrows
    0x2200, 0x22FF,  // − √ ∞ ∂ ∇ ≈ ≠ ≤ ≥
    0,
};

ImFont* addFace(ImFontAtlas& atlas, const FontStyle& style) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    // One sample a pixel: glyphs are placed on whole pixels and never filtered. Side bearings and
    // advances keep their fractions; the pen is rounded for each glyph.
    config.OversampleH = 1;
    config.OversampleV = 1;
    config.PixelSnapH = false;
    const auto file = fontFile(style.weight);
    return atlas.AddFontFromMemoryTTF(const_cast<std::byte*>(file.data()),  // read only
                                      static_cast<int>(file.size()),
                                      static_cast<float>(style.linePixels), &config, kGlyphRanges);
}

glm::ivec2 rounded(float x, float y) {
    return {static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))};
}

}  // namespace

std::span<const std::byte> fontFile(FontWeight weight) {
    const bool regular = weight == FontWeight::Regular;
    const auto* begin = regular ? isochron_inter_regular_begin : isochron_inter_semibold_begin;
    const auto* end = regular ? isochron_inter_regular_end : isochron_inter_semibold_end;
    return std::as_bytes(std::span(begin, end));
}

Font::Font(std::span<const FontStyle> styles) {
    ImFontAtlas built;
    built.Flags = ImFontAtlasFlags_NoMouseCursors | ImFontAtlasFlags_NoBakedLines |
                  ImFontAtlasFlags_NoPowerOfTwoHeight;
    std::vector<const ImFont*> fonts;
    for (const auto& style : styles) {
        assert(style.linePixels >= 4);
        fonts.push_back(addFace(built, style));
    }
    if (!built.Build()) throw std::runtime_error("the built-in font cannot be rasterised");
    atlasSize_ = {built.TexWidth, built.TexHeight};
    unsigned char* pixels = nullptr;
    built.GetTexDataAsAlpha8(&pixels, &atlasSize_.x, &atlasSize_.y);
    atlas_.assign(pixels, pixels + std::ptrdiff_t{atlasSize_.x} * atlasSize_.y);
    const glm::vec2 texels(atlasSize_);
    for (std::size_t i = 0; i < styles.size(); ++i) {
        Face face{styles[i], {}};
        for (const ImFontGlyph& glyph : fonts[i]->Glyphs) {
            face.glyphs[glyph.Codepoint] = {
                glyph.AdvanceX, rounded(glyph.X0, glyph.Y0),
                glyph.Visible ? rounded(glyph.X1 - glyph.X0, glyph.Y1 - glyph.Y0) : glm::ivec2(0),
                rounded(glyph.U0 * texels.x, glyph.V0 * texels.y)};
        }
        equaliseDigits(face.glyphs);
        faces_.push_back(std::move(face));
    }
}

// Inter's default digits are proportional and its tabular ones are behind an OpenType feature that
// stb_truetype does not read, so each digit is centred in the cell of the widest.
void Font::equaliseDigits(std::map<char32_t, Glyph>& glyphs) {
    float widest = 0;
    for (char32_t digit = U'0'; digit <= U'9'; ++digit) {
        widest = std::max(widest, glyphs.at(digit).advance);
    }
    for (char32_t digit = U'0'; digit <= U'9'; ++digit) {
        Glyph& glyph = glyphs.at(digit);
        glyph.offset.x += static_cast<int>(std::lround((widest - glyph.advance) / 2));
        glyph.advance = widest;
    }
}

const Font::Face& Font::face(FontStyle style) const {
    const auto found = std::find_if(faces_.begin(), faces_.end(),
                                    [&](const Face& face) { return face.style == style; });
    assert(found != faces_.end());
    return *found;
}

std::vector<GlyphQuad> Font::layout(std::string_view text, FontStyle style,
                                    glm::vec2 topLeft) const {
    const auto& glyphs = face(style).glyphs;
    const glm::ivec2 origin = rounded(topLeft.x, topLeft.y);
    std::vector<GlyphQuad> quads;
    float pen = 0;
    int line = 0;
    for (const char32_t point : codePoints(text)) {
        if (point == U'\n') {
            pen = 0;
            ++line;
            continue;
        }
        const auto found = glyphs.find(point);
        const Glyph& glyph = found != glyphs.end() ? found->second : glyphs.at(U'?');
        if (glyph.size.x > 0) {
            const glm::ivec2 start =
                origin + rounded(pen, 0) + glm::ivec2(0, line * style.linePixels);
            quads.push_back({start + glyph.offset, glyph.size, glyph.texel});
        }
        pen += glyph.advance;
    }
    return quads;
}

glm::vec2 Font::measure(std::string_view text, FontStyle style) const {
    const auto& glyphs = face(style).glyphs;
    float widest = 0, width = 0;
    int lines = 1;
    for (const char32_t point : codePoints(text)) {
        if (point == U'\n') {
            width = 0;
            ++lines;
            continue;
        }
        const auto found = glyphs.find(point);
        width += (found != glyphs.end() ? found->second : glyphs.at(U'?')).advance;
        widest = std::max(widest, width);
    }
    return {widest, static_cast<float>(lines * style.linePixels)};
}

float textCoverage(float atlasValue, float luminance) {
    // Black on white with 0.45 is close to blending encoded values, as browsers do. Seen side by
    // side at 14 to 36 pixels, dark-on-light and light-on-dark strokes then look equally heavy;
    // with 0.65, and more so with 1, dark labels of 14 to 18 pixels are grey and thin.
    constexpr float kBlackExponent = 0.45f;
    return std::pow(atlasValue, std::lerp(kBlackExponent, 1.0f, std::sqrt(luminance)));
}

void draw(Image& image, const Font& font, std::span<const GlyphQuad> quads, glm::vec4 color) {
    if (!(color.a > 0)) return;
    const float premultiplied = 0.2126f * color.r + 0.7152f * color.g + 0.0722f * color.b;
    const float luminance = std::clamp(premultiplied / color.a, 0.0f, 1.0f);
    const auto atlas = font.atlas();
    for (const auto& quad : quads) {
        const glm::ivec2 first = glm::max(-quad.topLeft, glm::ivec2(0));
        const glm::ivec2 last = glm::min(image.size - quad.topLeft, quad.size);
        for (int y = first.y; y < last.y; ++y) {
            for (int x = first.x; x < last.x; ++x) {
                const glm::ivec2 texel = quad.texel + glm::ivec2(x, y);
                const std::size_t i = static_cast<std::size_t>(texel.y) *
                                          static_cast<std::size_t>(font.atlasSize().x) +
                                      static_cast<std::size_t>(texel.x);
                const float coverage = textCoverage(static_cast<float>(atlas[i]) / 255, luminance);
                glm::vec4& pixel = image.at(quad.topLeft.x + x, quad.topLeft.y + y);
                pixel = color * coverage + pixel * (1 - color.a * coverage);
            }
        }
    }
}

}  // namespace render
