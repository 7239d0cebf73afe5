#include "render/annotate/axes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "render/annotate/axis_labels.h"
#include "render/annotate/box_edges.h"
#include "render/annotate/map_lines.h"
#include "render/image/color.h"

namespace render {

FontStyle labelStyle(glm::ivec2 pictureSize) {
    const double pixels = std::min(pictureSize.x, pictureSize.y) / 46.0;
    return {FontWeight::Regular, static_cast<int>(std::lround(std::clamp(pixels, 13.0, 40.0)))};
}

FontStyle titleStyle(glm::ivec2 pictureSize) {
    const double pixels = 1.3 * labelStyle(pictureSize).linePixels;
    return {FontWeight::SemiBold, static_cast<int>(std::lround(pixels))};
}

namespace {

const glm::vec3 kAxisEdge(linearFromSrgb8(134, 145, 162)), kNearEdge(linearFromSrgb8(84, 94, 110)),
    kFarEdge(linearFromSrgb8(52, 59, 71)), kNumber(linearFromSrgb8(170, 179, 193)),
    kTitle(linearFromSrgb8(230, 233, 239));

// Of maps: premultiplied, so that data show through where they lie below.
const glm::vec4 kCoast(0.8f * glm::vec3(linearFromSrgb8(160, 170, 184)), 0.8f),
    kGraticule(0.06f * glm::vec3(linearFromSrgb8(160, 170, 184)), 0.06f);

// A line where no text stands.
void lineAround(FlatMesh& mesh, std::span<const PixelRect> texts, const glm::dvec3& from,
                const glm::dvec3& to, float width, const glm::vec4& color) {
    for (const glm::dvec2& piece : piecesOutside(glm::dvec2(from), glm::dvec2(to), texts))
        mesh.line(glm::mix(from, to, piece[0]), glm::mix(from, to, piece[1]), width, color);
}

// What labels and their grounds are drawn with.
struct Pen {
    const Screen& screen;
    const Font& font;
    FontStyle style;
    glm::vec4 ground;
};

void drawLabel(AxesMeshes& meshes, const Pen& pen, const Label& label, const glm::vec3& color) {
    const glm::dvec3 at = pen.screen.pixel(label.anchor);
    const auto depth = static_cast<float>(at.z);
    const glm::vec2 topLeft = glm::round(glm::dvec2(at) + label.topLeft);
    meshes.labels.text(pen.font, pen.style, label.text, topLeft, color, depth);
    if (!meshes.labels.covers().empty())
        meshes.grounds.plate(meshes.labels.covers().back(),
                             0.2f * static_cast<float>(pen.style.linePixels), pen.ground, depth);
}

// Where lines of a picture go.
struct Lines {
    FlatMesh& mesh;
    std::span<const PixelRect> texts;  // where none are
    float width;
    glm::vec4 color;
};

// Lines of a map, from one place that can be told from that before to the next.
void drawMapLines(const Lines& into, const Screen& screen, const PlacedPoints& placed,
                  double height, const std::vector<MapLine>& lines) {
    constexpr double kApart = 1.5;  // pixels
    for (const MapLine& line : lines) {
        std::optional<glm::dvec3> last;
        glm::dvec3 from = placed.axesFromGrid({line[0], height});
        for (std::size_t i = 1; i < line.size(); ++i) {
            const glm::dvec3 to = placed.axesFromGrid({line[i], height});
            const auto part = screen.visible(from, to, Screen::Cut::NearPlane);
            if (part) {
                const glm::dvec3 end = screen.pixel(glm::mix(from, to, part->y));
                if (!last || part->x > 0) last = screen.pixel(glm::mix(from, to, part->x));
                const bool isLast = i + 1 == line.size() || part->y < 1;
                if (isLast || glm::distance(glm::dvec2(*last), glm::dvec2(end)) >= kApart) {
                    lineAround(into.mesh, into.texts, *last, end, into.width, into.color);
                    last = end;
                }
            }
            if (!part || part->y < 1) last.reset();
            from = to;
        }
    }
}

// The map below a grid of longitudes and latitudes, or above it: behind the volume where the eye
// sees the volume before it.
void drawMap(AxesMeshes& meshes, std::span<const PixelRect> texts, float width,
             const timeseries::Grid& grid, const PlacedPoints& placed, const Screen& screen,
             const glm::dvec3& midEye) {
    const auto plane = mapPlaneOf(grid);
    if (!plane) return;
    const double half = placed.boxHalf().z;
    const bool isBefore = half == 0 || midEye.z * plane->side > half;
    FlatMesh& mesh = isBefore ? meshes.mapBefore : meshes.mapBehind;
    drawMapLines({mesh, texts, width, kGraticule}, screen, placed, plane->height,
                 graticuleOf(*plane));
    drawMapLines({mesh, texts, width, kCoast}, screen, placed, plane->height,
                 linesWithin(*plane, coastlines()));
}

}  // namespace

AxesMeshes axesMeshes(const timeseries::Grid& grid, const PlacedPoints& placed,
                      const View& viewOfWorld, const glm::dvec3& midEyeInWorld, const Font& font,
                      const FlatMesh& legend, const glm::dvec3& background) {
    // In axis coordinates the box stands upright, however oblique it is in the world.
    const View view = placed.inAxes(viewOfWorld);
    const glm::dvec3 midEye = glm::inverse(placed.worldFromAxes()) * midEyeInWorld;
    const glm::dvec3 half = placed.boxHalf();
    const FontStyle style = labelStyle(view.size);
    const Sights sights(view, midEye, half);
    const Screen& screen = sights.eye();
    const auto axes =
        axisLabels(grid, placed, sights, midEye, view.size, font, style, legend.covers());
    const float width = std::max(1.0f, 0.06f * static_cast<float>(style.linePixels));

    AxesMeshes meshes;
    const Pen pen{screen, font, style, groundColor(background)};
    for (const AxisLabels& axis : axes) {
        for (const auto& number : axis.numbers)
            if (number) drawLabel(meshes, pen, *number, kNumber);
        if (axis.name) drawLabel(meshes, pen, *axis.name, kTitle);
    }
    // Lines give way to all texts, by a little more than their soft edges.
    std::vector<PixelRect> texts;
    for (const std::vector<PixelRect>& all : {legend.covers(), meshes.labels.covers()})
        for (const PixelRect& covers : all)
            texts.push_back(covers.grown(0.5 * static_cast<double>(width) + 1.5));
    for (const Edge& edge : edges(half)) {
        const glm::dvec3 a = edge.at(half, -1), b = edge.at(half, 1);
        const auto part = screen.visible(a, b, Screen::Cut::NearPlane);
        if (!part) continue;
        const bool labelled = std::any_of(axes.begin(), axes.end(), [&](const AxisLabels& axis) {
            return axis.edge.axis == edge.axis && axis.edge.side == edge.side;
        });
        const bool behind = lies(edge, half, midEye) == Lies::Behind;
        const glm::vec3 color = labelled ? kAxisEdge : behind ? kFarEdge : kNearEdge;
        lineAround(behind ? meshes.behind : meshes.before, texts,
                   screen.pixel(glm::mix(a, b, part->x)), screen.pixel(glm::mix(a, b, part->y)),
                   width, glm::vec4(color, 1));
    }
    drawMap(meshes, texts, width, grid, placed, screen, midEye);
    for (const AxisLabels& axis : axes) {
        for (const glm::dvec3& at : axis.places) {
            if (!screen.visible(at, at, Screen::Cut::NearPlane)) continue;
            const glm::dvec3 from = screen.pixel(at);
            lineAround(meshes.before, texts, from,
                       from + glm::dvec3(axis.outward * tickLength(style), 0), width,
                       glm::vec4(kAxisEdge, 1));
        }
    }
    return meshes;
}

}  // namespace render
