// The opaque reference scene: the points' box and its axes with ticks, numbers and units.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/flat_mesh.h"
#include "render/lattice.h"
#include "render/view.h"

namespace render {

// Label and title sizes that suit a picture: legible in a small one, not loud in a large one. The
// font of axes and legend has both.
FontStyle labelStyle(glm::ivec2 pictureSize);
FontStyle titleStyle(glm::ivec2 pictureSize);

// Lines carry the window depth of what they show; labels stand at depth 0 and hide nothing. The
// first lines, six vertices each, are the box's edges as far as they lie before the near plane.
struct AxesMeshes {
    FlatMesh lines, labels;
};
// Which edges carry the axes, and which ticks, is chosen from `midEye` (world), so that both eyes
// label the same ones. Labels lie inside the picture, outside the box, and apart from each other
// and from what `legend` draws; where there is no such place, they are left out. An axis that is
// nowhere on the box's outline (seen end on, or from inside) has none. REQUIRES: `font` has
// labelStyle(view.size).
AxesMeshes axesMeshes(const timeseries::Grid& grid, const Lattice& lattice, const View& view,
                      const glm::dvec3& midEye, const Font& font, const FlatMesh& legend = {});

// "°E" for degrees_east, "m s⁻¹" for m s-1, else the unit as it stands.
std::string shownUnit(const std::string& unit);

// Multiples of 1, 2 or 5 times a power of ten inside [lo, hi], about `wanted` of them (at least one
// where lo == hi); free of rounding noise, so that 0.3 prints as 0.3. REQUIRES: lo <= hi, both
// finite, wanted >= 1.
std::vector<double> niceTicks(double lo, double hi, int wanted);

// Numbers written alike, as the labels of one axis: as many decimals as the one that needs most,
// powers of ten where plain digits would be long: "0.5", "1.0", "−2×10⁻⁹".
std::vector<std::string> tickTexts(std::span<const double> ticks);

}  // namespace render
