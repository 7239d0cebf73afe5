// The colours of a layer over the values that it shows, and the numbers below them.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "render/annotate/flat_mesh.h"
#include "render/model/scene.h"

namespace render {

extern const glm::vec3 kLegendQuiet;  // of texts that say less than others, linear

// Values lie along it evenly from the least to the greatest; between its parts there is nothing.
struct ColorBar {
    ByValue style;
    std::vector<std::pair<double, double>> parts;  // ascending, apart; one or more
    std::string below, above;                      // before the numbers of its ends
    std::string words = {};                        // in place of numbers, where there are any

    double lo() const { return parts.front().first; }
    double hi() const { return parts.back().second; }
};

// "300 – ≥ 1600": what it spans, where no numbers stand below it.
std::string spanText(const ColorBar& bar);
// Framed: the dark end of many maps is the background's colour.
void drawBar(FlatMesh& mesh, const ColorBar& bar, glm::vec2 from, glm::vec2 to);
// With the numbers of its ends and, where there is room, of the gaps' ends, or of a round value
// between.
void drawScale(FlatMesh& mesh, const Font& font, FontStyle style, const ColorBar& bar,
               glm::vec2 topLeft, float width);

}  // namespace render
