#include "tests/ui/screen_text.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "app/panels/theme.h"

namespace ui {
namespace {

constexpr float kLabelWidth = 104;  // app/panels/form.cpp
constexpr float kSame = 0.25f;      // other glyphs differ by more, rounding and neighbours by less

std::array<std::uint8_t, 3> bytesOf(ImU32 color) {
    return {static_cast<std::uint8_t>(color >> IM_COL32_R_SHIFT),
            static_cast<std::uint8_t>(color >> IM_COL32_G_SHIFT),
            static_cast<std::uint8_t>(color >> IM_COL32_B_SHIFT)};
}

bool isReadable(const ImFontGlyph& glyph) {
    return (glyph.Codepoint > ' ' && glyph.Codepoint < 0x7f) ||
           (glyph.Codepoint >= 0x391 && glyph.Codepoint <= 0x3a9);
}

void append(std::string& text, unsigned codepoint) {
    if (codepoint < 0x80) {
        text += static_cast<char>(codepoint);
        return;
    }
    text += static_cast<char>(0xc0 | (codepoint >> 6));
    text += static_cast<char>(0x80 | (codepoint & 0x3f));
}

}  // namespace

ScreenText::ScreenText() {
    ImGui::CreateContext();
    const app::panels::Theme theme = app::panels::makeTheme(1);
    unsigned char* pixels = nullptr;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width_, &height_);
    atlas_.assign(pixels, pixels + static_cast<std::ptrdiff_t>(width_) * height_);
    linePixels_ = static_cast<int>(theme.text->FontSize);
    std::ranges::copy_if(theme.text->Glyphs, std::back_inserter(glyphs_), isReadable);
}

ScreenText::~ScreenText() { ImGui::DestroyContext(); }

float ScreenText::Ink::at(int x, int y) const {
    if (x < 0 || y < 0 || x >= shot.size.x || y >= shot.size.y) return 0;
    constexpr std::size_t kGreen = 1;
    const auto ground = bytesOf(app::panels::kPanel)[kGreen];
    return static_cast<float>(shot.at({x, y})[kGreen] - ground) /
           static_cast<float>(color[kGreen] - ground);
}

float ScreenText::atlas(int x, int y) const {
    const int column = std::clamp(x, 0, width_ - 1), row = std::clamp(y, 0, height_ - 1);
    return static_cast<float>(atlas_[static_cast<std::size_t>(row * width_ + column)]) / 255;
}

// As GL samples it, linearly between the texels' centres; `at` from the pen and the line's top.
float ScreenText::drawn(const ImFontGlyph& glyph, glm::vec2 at) const {
    const glm::vec2 lo(glyph.X0, glyph.Y0), hi(glyph.X1, glyph.Y1);
    if (at.x < lo.x || at.y < lo.y || at.x >= hi.x || at.y >= hi.y) return 0;
    const glm::vec2 size(width_, height_), first(glyph.U0, glyph.V0), last(glyph.U1, glyph.V1);
    const glm::vec2 texel = size * (first + (last - first) * (at - lo) / (hi - lo)) - 0.5f;
    const glm::vec2 corner = glm::floor(texel), t = texel - corner;
    const auto x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(atlas(x, y), atlas(x + 1, y), t.x),
                    glm::mix(atlas(x, y + 1), atlas(x + 1, y + 1), t.x), t.y);
}

float ScreenText::unlike(const Ink& ink, glm::ivec2 corner, float pen,
                         const ImFontGlyph& glyph) const {
    const int from = static_cast<int>(std::ceil(pen + std::min(0.0f, glyph.X0))),
              to = static_cast<int>(std::floor(pen + std::max(glyph.AdvanceX, glyph.X1)));
    float off = 0, whole = 0;
    for (int y = 0; y < linePixels_; ++y)
        for (int x = from; x < to; ++x) {
            const float wanted =
                drawn(glyph, {static_cast<float>(x) + 0.5f - pen, static_cast<float>(y) + 0.5f});
            off += std::abs(ink.at(corner.x + x, corner.y + y) - wanted);
            whole += wanted;
        }
    return off / whole;
}

const ImFontGlyph* ScreenText::glyphAt(const Ink& ink, glm::ivec2 corner, float pen) const {
    const ImFontGlyph* best = nullptr;
    float least = kSame;
    for (const ImFontGlyph& glyph : glyphs_) {
        const float off = unlike(ink, corner, pen, glyph);
        if (off >= least) continue;
        least = off;
        best = &glyph;
    }
    return best;
}

std::string ScreenText::line(const Ink& ink, glm::ivec2 corner) const {
    const float space = ImGui::GetIO().Fonts->Fonts[0]->GetCharAdvance(' ');
    std::string text, spaces;
    for (float pen = 0; spaces.size() < 5;) {
        if (const ImFontGlyph* glyph = glyphAt(ink, corner, pen)) {
            text += std::exchange(spaces, {});
            append(text, glyph->Codepoint);
            pen += glyph->AdvanceX;
        } else if (text.empty()) {
            return {};
        } else {
            spaces += ' ';
            pen += space;
        }
    }
    return text;
}

std::string ScreenText::beside(const Shot& shot, const app::panels::Rect& page,
                               const std::string& label) const {
    const glm::ivec2 first(page.min + glm::vec2(app::panels::kMargin, 0));
    for (int y = first.y; y + linePixels_ <= static_cast<int>(page.max.y); ++y)
        if (line({shot, bytesOf(app::panels::kDim)}, {first.x, y}) == label)
            return line({shot, bytesOf(app::panels::kText)},
                        {first.x + static_cast<int>(kLabelWidth), y});
    return {};
}

}  // namespace ui
