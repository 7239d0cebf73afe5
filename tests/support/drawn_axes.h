// Boxes of grids with their axes, drawn.
#pragma once

#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "render/annotate/axes.h"
#include "tests/support/flat_text.h"
#include "tests/support/measured_axis.h"
#include "tests/support/scenes.h"

namespace render::drawn_axes {

using tests::fontFor;
using tests::lookFrom;
using tests::Rect;
using timeseries::Grid;

inline Grid fire() {
    const double lo = 1 / 120.0, hi = 119 / 120.0;
    return Grid({tests::measuredAxis("x", "m", lo, hi, 60),
                 tests::measuredAxis("y", "m", lo, hi, 60),
                 tests::measuredAxis("z", "m", lo, hi, 60)});
}
inline Grid ocean() {
    return Grid({tests::measuredAxis("lon", "degrees_east", 20.5, 378.5, 180),
                 tests::measuredAxis("lat", "degrees_north", -89.5, 89.5, 90),
                 tests::measuredAxis("depth", "m", 0, 1000, 19, true)});
}
// The fire's grid, leaning and mirrored.
inline Grid sheared() {
    return Grid(fire().axes(), {tests::leaning({1, 0.3, 0}, {0.5, -1, 0}, {0.4, 0.2, 1})});
}
inline std::vector<Grid> worlds() {
    return {fire(),
            ocean(),
            Grid({tests::measuredAxis("x", "index", 0, 255, 256),
                  tests::measuredAxis("y", "index", 3, 0, 4),
                  tests::measuredAxis("z", "index", 0, 0, 1)}),
            Grid({tests::measuredAxis("easting", "m", 412000, 418000, 7),
                  tests::measuredAxis("northing", "m", 5416000, 5412000, 5),
                  tests::measuredAxis("height above the ground", "m", -2e-9, 1e7, 9)}),
            Grid({tests::measuredAxis("x", "m", 10000000, 10000000.004, 5),
                  tests::measuredAxis("y", "m", 0, 0.001, 5),
                  tests::measuredAxis("z", "", 0, 1e-3, 2)}),
            Grid({tests::measuredAxis("x", "m", 0, 1e-30, 5),
                  tests::measuredAxis("y", "m", 0, 0, 1), tests::measuredAxis("z", "m", 0, 0, 1)}),
            Grid({tests::measuredAxis("x", "m", 4, 4, 1), tests::measuredAxis("y", "m", 0, 0, 1),
                  tests::measuredAxis("z", "m", 0, 0, 1)}),
            sheared(),
            Grid(ocean().axes(), {tests::rotation(2)})};
}

inline glm::dvec3 eyeAt(double azimuth, double elevation, double distance) {
    const double a = glm::radians(azimuth), e = glm::radians(elevation);
    return distance * glm::dvec3(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
}

struct Drawn {
    PlacedPoints placed;
    View view;
    const Font& font;
    AxesMeshes meshes;
    Drawn(const Grid& grid, const glm::dvec3& eye, glm::ivec2 size, double tangent = 0.4)
        : placed(grid),
          view(lookFrom(eye, size, tangent)),
          font(fontFor(size)),
          meshes(axesMeshes(grid, placed, view, {eye}, font)) {}
    std::optional<Rect> label(const std::string& text) const {
        return tests::find(meshes.labels, font, labelStyle(view.size), text);
    }
};

// Picture pixels and window depth by the definitions in view.h, with lookFrom's near and far.
inline glm::dvec3 seen(const View& view, const glm::dvec3& world) {
    const Projected p = project(view, world);
    const double near = 0.01, far = 5000;
    return {p.window.x, view.size.y - p.window.y,
            far * (p.depth - near) / (p.depth * (far - near))};
}

}  // namespace render::drawn_axes
