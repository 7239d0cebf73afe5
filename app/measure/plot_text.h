// Texts of a plot: what is drawn of them, and how wide they are.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/measure/plot.h"

namespace app {

// As text of one line: well-formed UTF-8, a space for each control character.
std::string printable(std::string_view text);

// Pixels of a picture to one of the plot, across and down: a screen may have so many.
inline constexpr int kPlotScale = 2;

// The font inside the program, as large as pictures of plots have it. Immutable.
class PlotFont {
 public:
    // Rasterises the letterings, which takes milliseconds.
    explicit PlotFont(std::span<const Lettering> letterings);

    // REQUIRES of all: a lettering given to the constructor, printable text.
    double width(std::string_view text, const Lettering& lettering) const;  // pixels of the plot
    // All of it where it is at most so wide, else its beginning and an ellipsis.
    std::string shortened(const std::string& text, const Lettering& lettering, double width) const;
    // In pixels of the picture: where the text begins, above left of its first letter.
    glm::dvec2 topLeft(const PlotText& text) const;

    const render::Font& font() const { return font_; }
    static render::FontStyle style(const Lettering& lettering);

 private:
    render::Font font_;
};

}  // namespace app
