#include "render/annotate/axes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "render/annotate/axes_parts.h"
#include "render/annotate/axis_labels.h"
#include "render/annotate/box_edges.h"
#include "render/annotate/globe_meshes.h"
#include "render/annotate/legend.h"
#include "render/annotate/map_lines.h"

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

// At that height.
void drawMapLines(const Lines& into, const Screen& screen, const PlacedPoints& placed,
                  double height, const std::vector<MapLine>& lines) {
    for (const MapLine& line : lines) {
        std::vector<glm::dvec3> places;
        for (const glm::dvec2& at : line) places.push_back(placed.axesFromGrid({at, height}));
        drawPath(into, screen, places);
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
    drawMapLines({mesh, texts, width, lineColors().graticule}, screen, placed, plane->height,
                 graticuleOf(*plane));
    drawMapLines({mesh, texts, width, lineColors().coast}, screen, placed, plane->height,
                 linesWithin(*plane, coastlines()));
}

}  // namespace

AxesMeshes axesMeshes(const timeseries::Grid& grid, const PlacedPoints& placed,
                      const View& viewOfWorld, const Middle& middleOfWorld, const Font& font,
                      const FlatMesh& legend, const glm::dvec3& background) {
    // In axis coordinates the box stands upright, however oblique it is in the world.
    const View view = placed.inAxes(viewOfWorld);
    const glm::dvec3 midEye = glm::inverse(placed.worldFromAxes()) * middleOfWorld.eye;
    const Middle middle{midEye, middleOfWorld.lean};
    if (placed.globe()) return globeMeshes(placed, view, middle, font, legend, background);
    const glm::dvec3 half = placed.boxHalf();
    const FontStyle style = labelStyle(view.size);
    const Sights sights(view, middle, half);
    const Screen& screen = sights.eye();
    const auto axes = axisLabels(grid, placed, sights, midEye, view.size, font, style,
                                 coveredByLegend(legend, view.size));
    const float width = lineWidth(style);
    const LineColors& colors = lineColors();

    AxesMeshes meshes;
    const Pen pen{screen, font, style, groundColor(background)};
    for (const AxisLabels& axis : axes) {
        for (const auto& number : axis.numbers)
            if (number) drawLabel(meshes, pen, *number, colors.number);
        if (axis.name) drawLabel(meshes, pen, *axis.name, colors.title);
    }
    // Lines give way to all texts.
    const std::vector<PixelRect> texts = textsOf(legend, meshes, width);
    for (const Edge& edge : edges(half)) {
        const glm::dvec3 a = edge.at(half, -1), b = edge.at(half, 1);
        const auto part = screen.visible(a, b, Screen::Cut::NearPlane);
        if (!part) continue;
        const bool labelled = std::any_of(axes.begin(), axes.end(), [&](const AxisLabels& axis) {
            return axis.edge.axis == edge.axis && axis.edge.side == edge.side;
        });
        const bool behind = lies(edge, half, midEye) == Lies::Behind;
        const glm::vec3 color = labelled ? colors.axisEdge
                                : behind ? colors.farEdge
                                         : colors.nearEdge;
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
                       glm::vec4(colors.axisEdge, 1));
        }
    }
    return meshes;
}

}  // namespace render
