// What stands in a picture: its texts as rectangles, and the edges of the box that are seen.
#pragma once

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "render/annotate/axes.h"
#include "render/annotate/axis_labels.h"
#include "render/annotate/legend.h"
#include "tests/support/flat_text.h"

namespace tests::text_page {

// A picture's texts and lines, as they are drawn.
struct Page {
    glm::ivec2 size;
    render::FlatMesh legend;
    render::AxesMeshes axes;
    std::vector<render::AxisLabels> labels;
    render::Sights sights;

    Page(const timeseries::Grid& grid, const render::PlacedPoints& placed, const render::View& view,
         const render::Middle& middle, const render::Legend& words)
        : size(view.size),
          legend(render::legendMesh(words, fontFor(size), size)),
          axes(render::axesMeshes(grid, placed, view, middle, fontFor(size), legend)),
          sights(placed.inAxes(view), {inAxes(placed, middle.eye), middle.lean}, placed.boxHalf()) {
        labels = render::axisLabels(grid, placed, sights, inAxes(placed, middle.eye), size,
                                    fontFor(size), render::labelStyle(size), plates());
    }
    static glm::dvec3 inAxes(const render::PlacedPoints& placed, const glm::dvec3& world) {
        return glm::inverse(placed.worldFromAxes()) * world;
    }
    double line() const { return render::labelStyle(size).linePixels; }
    std::vector<render::PixelRect> plates() const { return render::coveredByLegend(legend, size); }
    render::PixelRect seen(const render::Label& label) const {
        return label.ink.moved(sights.pixel(0, label.anchor));
    }
    std::vector<render::PixelRect> texts() const {
        std::vector<render::PixelRect> all = legend.covers();
        all.insert(all.end(), axes.labels.covers().begin(), axes.labels.covers().end());
        return all;
    }
    std::vector<std::string> numbers(const render::AxisLabels& axis) const {
        std::vector<std::string> all;
        for (const auto& number : axis.numbers)
            all.push_back(number ? number->text : std::string());
        return all;
    }
    std::vector<std::string> words() const {
        std::vector<std::string> all;
        for (const render::AxisLabels& axis : labels) {
            for (const std::string& number : numbers(axis)) all.push_back(number);
            all.push_back(axis.name ? axis.name->text : std::string());
        }
        return all;
    }
};

// An edge of the box in a picture.
struct SeenEdge {
    render::Edge edge;
    glm::dvec2 from, to;
    bool outline;
};
inline std::vector<SeenEdge> edgesIn(const Page& page, const render::PlacedPoints& placed,
                                     const glm::dvec3& midEye) {
    const auto half = placed.boxHalf();
    std::vector<SeenEdge> found;
    for (const render::Edge& edge : render::edges(half)) {
        const glm::dvec3 a = edge.at(half, -1), b = edge.at(half, 1);
        const auto part = page.sights.middle().visible(a, b, render::Screen::Cut::Picture);
        if (!part) continue;
        found.push_back({edge, page.sights.pixel(0, glm::mix(a, b, part->x)),
                         page.sights.pixel(0, glm::mix(a, b, part->y)),
                         lies(edge, half, Page::inAxes(placed, midEye)) == render::Lies::Outline});
    }
    return found;
}

inline bool isLabelled(const SeenEdge& shown, const render::AxisLabels& axis) {
    return shown.edge.axis == axis.edge.axis && shown.edge.side == axis.edge.side;
}

}  // namespace tests::text_page
