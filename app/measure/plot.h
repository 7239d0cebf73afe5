// A plot as shapes, before it is a file: what every writer of plots draws.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <variant>
#include <vector>

#include "render/annotate/font.h"

namespace app {

using PlotColor = std::uint32_t;  // 0xRRGGBB, sRGB

// Lengths and places are pixels of the plot, y down; a file may have several of its own to each.
struct PlotLine {
    glm::dvec2 from, to;
    PlotColor color = 0;
    double width = 1;
    double dash = 0, gap = 0;  // along it, a dash first; no dash: unbroken
};

// A hollow one's fill is the paper's.
struct PlotCircle {
    glm::dvec2 middle;
    double radius = 1;  // to the middle of its rim
    PlotColor fill = 0, rim = 0;
    double rimWidth = 1;
    std::string tip = {};  // for those who point at it, where a file can tell them
};

struct Lettering {
    double size = 12;  // of the em, as CSS has font-size
    render::FontWeight weight = render::FontWeight::Regular;

    bool operator==(const Lettering&) const = default;
};

enum class Anchor { Start, Middle, End };

struct PlotText {
    glm::dvec2 at;  // on its baseline
    Anchor anchor = Anchor::Start;
    Lettering lettering = {};
    PlotColor color = 0;
    std::string text = {};  // any bytes; writers draw control characters as spaces
};

using PlotShape = std::variant<PlotLine, PlotCircle, PlotText>;

inline constexpr PlotColor kPaper = 0xffffff;

// REQUIRES of writers: a size >= 1.
struct Plot {
    glm::ivec2 size{1};
    std::vector<PlotShape> shapes;  // later ones over earlier ones
};

}  // namespace app
