// What a picture says of itself in words: variable, time, layers, and what was bent to draw it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/annotate/flat_mesh.h"
#include "render/model/scene.h"

namespace render {

struct LegendLayer {
    RangeStyle style;
    std::string range;   // "600:1600 K"
    std::string amount;  // "13,402 points, 6.2 %"
    // The values that a colour bar covers, ascending and apart; all of the map where empty.
    std::vector<std::pair<double, double>> shown = {};
    // Of a range without an end: the bar's end has the colour of all that lies beyond it, too.
    bool openBelow = false, openAbove = false;
    // Of a map without a width, which gives all values its middle colour: what stands below its
    // bar.
    std::string ofOneColor = {};  // "all 5"
};

struct Legend {
    std::string title;                // "T, temperature (K)"
    std::string time;                 // "1.10 s, step 13 of 31"
    std::vector<LegendLayer> layers;  // in the order of the scene's
    std::vector<std::string> notes;   // "depth drawn stretched", "drawn in index space"
    std::string emptiness = {};       // "all 8 points of this step are missing"; "" when not
};

// About what a legend takes of a picture's upper left corner, with its plate, whatever its words
// and numbers are: of so many layers with a colour bar, and with a swatch. A picture that is placed
// by it stands still when they change.
glm::dvec2 legendCorner(std::size_t bars, std::size_t swatches, glm::ivec2 pictureSize);
FlatMesh legendMesh(const Legend& legend, const Font& font, glm::ivec2 pictureSize);
// What is drawn under it: one plate under texts that stand close to each other.
FlatMesh legendGround(const FlatMesh& legend, glm::ivec2 pictureSize, const glm::dvec3& background);
// What that covers, with its soft edges: nothing else can be read there.
std::vector<PixelRect> coveredByLegend(const FlatMesh& legend, glm::ivec2 pictureSize);

}  // namespace render
