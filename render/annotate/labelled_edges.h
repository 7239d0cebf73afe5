// The edges that labels of axes go with, and the numbers along them: a part of axis_labels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/annotate/axis_labels.h"

namespace render {

constexpr double kLeastLabelMargin = 2;  // pixels between a label and the picture's edge

// Everything that labels are placed by.
struct LabelPage {
    const timeseries::Grid& grid;
    const PlacedPoints& placed;
    const Sights& sights;
    const glm::dvec3& midEye;
    glm::dvec2 size;
    const Font& font;
    FontStyle style;

    double line() const { return style.linePixels; }
    double gap() const { return 0.38 * line(); }
    // What stays free around names, as around the legend.
    double margin() const { return std::min(0.9 * line(), 0.06 * std::min(size.x, size.y)); }
};

// An edge and the part of it that is in the picture, as the middle sees it.
struct Stretch {
    Edge edge;
    glm::dvec3 a, b;  // ends of that part
    glm::dvec2 part;  // as fractions of the edge
    glm::dvec2 from, to, outward;
    bool outline;

    double pixels() const { return glm::distance(from, to); }
};

// The edges of an axis in the picture, the best first: those on the outline, of x and y from the
// lowest, of z from the leftmost; others, from the longest, only where there is none.
std::vector<Stretch> stretches(const LabelPage& page, int axis);
// Enough for two numbers, perhaps.
bool isLong(const LabelPage& page, const Stretch& stretch);

// A text and what it covers, laid out once for the many places where it is tried.
struct Words {
    std::string text;
    PixelRect ink;  // of the text at (0, 0)

    glm::dvec2 size() const { return ink.hi - ink.lo; }
};
Words wordsOf(const LabelPage& page, std::string text);
// A label whose ink has its middle there, from where the anchor is seen.
Label centred(const Words& words, const glm::dvec3& anchor, const glm::dvec2& middle);
// The middle of ink that lies that far beyond its anchor.
glm::dvec2 beyond(const Words& words, const glm::dvec2& outward, double away);

// As many ticks as stand apart along a stretch, two numbers among them where that can be. Numbers
// that have no place are left out.
AxisLabels numbered(const LabelPage& page, const LabelPlaces& places, const Stretch& stretch);
std::ptrdiff_t numberCount(const AxisLabels& shown);

}  // namespace render
