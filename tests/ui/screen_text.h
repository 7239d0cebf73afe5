// Reads what a panel says: the interface's own glyphs, looked for pixel by pixel.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/panels/layout.h"
#include "tests/ui/shot.h"

struct ImFontGlyph;

namespace ui {

// The interface's usual font at scale 1. It has an ImGui context of its own: one at a time.
class ScreenText {
 public:
    ScreenText();
    ~ScreenText();
    ScreenText(const ScreenText&) = delete;
    ScreenText& operator=(const ScreenText&) = delete;

    // What a row of a page says: the text at its control's place, found by the label left of it.
    // Empty where no row has that label. ASCII and Greek capitals.
    std::string beside(const Shot& shot, const app::panels::Rect& page,
                       const std::string& label) const;

 private:
    // How much of a pixel is text, [0, 1], on the colour of panels.
    struct Ink {
        const Shot& shot;
        std::array<std::uint8_t, 3> color;
        float at(int x, int y) const;
    };

    // The line whose first glyph's box has its upper left corner there. What is no glyph is a
    // space, and five of them are the line's end.
    std::string line(const Ink& ink, glm::ivec2 corner) const;
    // The glyph that stands there, the pen being `pen` pixels right of the corner.
    const ImFontGlyph* glyphAt(const Ink& ink, glm::ivec2 corner, float pen) const;
    // How much what is there differs from what the glyph would draw, as a share of its ink.
    float unlike(const Ink& ink, glm::ivec2 corner, float pen, const ImFontGlyph& glyph) const;
    float drawn(const ImFontGlyph& glyph, glm::vec2 at) const;
    float atlas(int x, int y) const;

    int width_ = 0, height_ = 0, linePixels_ = 0;
    std::vector<std::uint8_t> atlas_;  // [y][x], coverage
    std::vector<ImFontGlyph> glyphs_;
};

}  // namespace ui
