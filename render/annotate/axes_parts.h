// What is drawn alike beside a box and on a globe: lines where no text stands, and labels.
#pragma once

#include <span>

#include "render/annotate/axes.h"
#include "render/annotate/label_places.h"

namespace render {

// A line where no text stands.
void lineAround(FlatMesh& mesh, std::span<const PixelRect> texts, const glm::dvec3& from,
                const glm::dvec3& to, float width, const glm::vec4& color);

// Where lines of a picture go.
struct Lines {
    FlatMesh& mesh;
    std::span<const PixelRect> texts;  // where none are
    float width;
    glm::vec4 color;
};
// Through places in axis coordinates, from one that can be told from that before to the next.
void drawPath(const Lines& into, const Screen& screen, std::span<const glm::dvec3> places);

// What labels and their grounds are drawn with.
struct Pen {
    const Screen& screen;
    const Font& font;
    FontStyle style;
    glm::vec4 ground;
};
void drawLabel(AxesMeshes& meshes, const Pen& pen, const Label& label, const glm::vec3& color);

float lineWidth(FontStyle style);
// All texts, by a little more than lines' soft edges.
std::vector<PixelRect> textsOf(const FlatMesh& legend, const AxesMeshes& meshes, float width);

// Linear; of maps premultiplied, so that data show through where they lie below.
struct LineColors {
    glm::vec3 axisEdge, nearEdge, farEdge, number, title;
    glm::vec4 coast, graticule;
};
const LineColors& lineColors();

}  // namespace render
