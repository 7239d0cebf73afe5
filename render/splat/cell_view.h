// A scene of cells in one view, and one of its cells there, as the kernels of cell_kernels.h take
// them.
#pragma once

#include <array>
#include <cstdint>

#include "render/model/cell_splat.h"
#include "render/model/light.h"
#include "render/splat/tile_layout.h"

namespace render {

// The placed points must outlive it.
struct CellView : TileLayout {
    CellView(const Scene& scene, const View& view, Channels channels);

    PointsView seen;
    float weight;     // W of a unit of depth along the view axis
    float rayLength;  // of a unit of depth there, in the world
    Light light;      // Off, but for Over
    double steep;     // what gradients are measured against, of the field a length of the world
    bool byValue;     // some layer's colours are
    std::array<float, 6> metric;  // gradientMetric()

 private:
    CellView(const PointsView& seen, const Scene& scene, const View& view, Channels channels);
};

// A gradient's square in the world is the first three times the squares of what it is along the
// axes, and the others times their products xy, xz, yz.
std::array<float, 6> gradientMetric(const PlacedPoints& placed);
// What gradients are measured against, of the field a length of the world (render/model/light.h).
double steepnessOf(const Scene& scene);
// What gradients of f in a cell are measured against: a plateau is lit evenly.
float steepnessIn(const CellSplat<float>& cell, double steep);

// Where values of a cell are in a map, [0, 1] in it: that of f is at + f perValue.
struct CellMapPlace {
    double at, perValue;
};
CellMapPlace mapPlaceOf(const ByValue& style, const CellSplat<float>& cell);
// Such places as floats, and what is more than floats hold.
float floatPlace(double at);

// A CellSplat in a picture.
struct SeenCell {
    float base = 0;
    float ox = 0, oy = 0;  // of its first pixel's centre from its own
    std::array<float, 3> at{}, ray{}, perSize{};
    std::array<float, 8> f{};
    float least = 0, most = 0;
    bool crossesLeast = false, crossesMost = false;
    float perRange = 0;
    float tint = 0, tintPerValue = 0;  // place among the tints where f = 0, and what f adds to it
    float firstTint = 0, lastTint = 0;
    float steep = 0;  // CellView::steep as the gradient of f
    // In the layout's box; none where the view does not see it.
    std::int32_t x = 0, y = 0, columns = 0, rows = 0;
};

SeenCell seenCell(const CellView& view, const ValuedCell& cell, std::size_t layer,
                  const RangeStyle& style);

}  // namespace render
