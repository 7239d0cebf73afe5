// The opaque reference scene: the points' box and its axes with ticks, numbers and units.
#pragma once

#include "render/flat_mesh.h"
#include "render/lattice.h"
#include "render/view.h"

namespace render {

// A label size that suits a picture: legible in a small one, not loud in a large one.
FontStyle labelStyle(glm::ivec2 pictureSize);
FontStyle titleStyle(glm::ivec2 pictureSize);

// Lines carry the window depth of what they show; labels stand at depth 0 and hide nothing.
struct AxesMeshes {
    FlatMesh lines, labels;
};
// Which edges carry the axes is chosen from `midEye`, so that both eyes label the same ones.
AxesMeshes axesMeshes(const timeseries::Grid& grid, const Lattice& lattice, const View& view,
                      const glm::dvec3& midEye, const Font& font);

// "°E" for degrees_east, else the unit as it stands.
std::string shownUnit(const std::string& unit);

// Multiples of 1, 2 or 5 times a power of ten inside [lo, hi], about `wanted` of them (at least one
// where lo == hi); free of rounding noise, so that 0.3 prints as 0.3.
std::vector<double> niceTicks(double lo, double hi, int wanted);

}  // namespace render
