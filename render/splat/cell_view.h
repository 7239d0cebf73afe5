// A scene of cells in one view, and one of its cells or tetrahedra there, as the kernels of
// cell_kernels.h and tet_kernels.h take them.
#pragma once

#include <array>
#include <cstdint>

#include "render/model/cell_splat.h"
#include "render/model/light.h"
#include "render/model/tet_splat.h"
#include "render/splat/tile_layout.h"

namespace render {

// The placed points must outlive it.
struct CellView : TileLayout {
    CellView(const Scene& scene, const View& view, Channels channels, int raysAcross);

    PointsView seen;
    float weight;     // W of a unit of depth along the view axis
    float rayLength;  // of a unit of depth there, in the world
    Light light;      // Off, but for Over
    double steep;     // what gradients are measured against, of the field a length of the world
    bool byValue;     // some layer's colours are
    std::array<float, 6> metric;  // gradientMetric()

 private:
    CellView(const PointsView& seen, const Scene& scene, const View& view, Channels channels,
             int raysAcross);
};

// A gradient's square in the world is the first three times the squares of what it is along the
// axes, and the others times their products xy, xz, yz.
std::array<float, 6> gradientMetric(const PlacedPoints& placed);
// What gradients are measured against, of the field a length of the world (render/model/light.h).
double steepnessOf(const Scene& scene);
// What gradients of f are measured against, where the field is reference + extent f: a plateau is
// lit evenly. More would leave the floats.
constexpr double kSteepest = 1e10;
float steepnessIn(double extent, double steep);

// Where values of a cell are in a map, [0, 1] in it: that of f is at + f perValue.
struct CellMapPlace {
    double at, perValue;
};
CellMapPlace mapPlaceOf(const ByValue& style, double reference, double extent);
// Such places as floats, and what is more than floats hold.
float floatPlace(double at);

// What a cell and a tetrahedron have alike in a picture.
struct SeenPiece {
    float base = 0;
    float ox = 0, oy = 0;  // of its first pixel's centre from its own
    float least = 0, most = 0;
    bool crossesLeast = false, crossesMost = false;
    float perRange = 0;
    float tint = 0, tintPerValue = 0;  // place among the tints where f = 0, and what f adds to it
    float firstTint = 0, lastTint = 0;
    // In the layout's box; none where the view does not see it.
    std::int32_t x = 0, y = 0, columns = 0, rows = 0;
};
// Of one of that layer, whose field is reference + extent f.
void takeTints(SeenPiece& c, const CellView& view, std::size_t layer, const RangeStyle& style,
               double reference, double extent);

// A CellSplat in a picture.
struct SeenCell : SeenPiece {
    std::array<float, 3> at{}, ray{}, perSize{};
    std::array<float, 3> right{}, up{};  // what a pixel adds to the ray
    std::array<float, 8> f{};
    float steep = 0;      // CellView::steep as the gradient of f
    bool grazes = false;  // some of its rays may lie along a face
};

// A TetSplat in a picture.
struct SeenTet : SeenPiece {
    std::array<float, 4> at{}, ray{}, right{}, up{};         // the corners' shares
    float f = 0, fRay = 0, fRight = 0, fUp = 0, across = 0;  // of a pixel, a unit of depth away
    float perSteepness = 0, certainty = 0;                   // of light
};
SeenTet seenTet(const CellView& view, const ValuedTet& tet, std::size_t layer,
                const RangeStyle& style);

}  // namespace render
