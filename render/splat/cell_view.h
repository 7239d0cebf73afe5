// A scene of cells in one view, and one of its cells or tetrahedra there, as the kernels of
// cell_kernels.h and tet_kernels.h take them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/model/cell_splat.h"
#include "render/model/light.h"
#include "render/model/tet_splat.h"
#include "render/splat/tile_bins.h"
#include "render/splat/tile_layout.h"

namespace render {

// Of a lamp that stands in the world: its direction's part of a gradient along the axes, and of a
// way along them.
struct AxisLamp {
    glm::vec3 ofGradient, ofWay;
};
// None where it is at the eye, or there is no light.
std::optional<AxisLamp> axisLamp(const Scene& scene, Channels channels);

// The placed points must outlive it.
struct CellView : TileLayout {
    CellView(const Scene& scene, const View& view, Channels channels, int raysAcross);

    PointsView seen;
    float weight;     // W of a unit of depth along the view axis
    float rayLength;  // of a unit of depth there, in the world
    Light light;      // Off, but for Over
    std::optional<AxisLamp> lamp;
    double steep;  // what gradients are measured against, of the field a length of the world
    bool byValue;  // some layer's colours are
    std::array<float, 6> metric;  // gradientMetric()
    bool isUpright;               // its last three are 0

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
CellMapPlace mapPlaceOf(const ByValue& style, const cell::ColoredField& field);
// Such places as floats, and what is more than floats hold.
float floatPlace(double at);

// What a cell and a tetrahedron have alike in a picture.
struct SeenPiece {
    float base;
    float ox, oy;  // of its first pixel's centre from its own
    float perRange;
    float least, most;
    std::uint32_t flags;       // of PieceFlag
    std::int32_t x, y;         // the first pixel, in the layout's box
    std::uint32_t lastPixels;  // columns - 1 + 2^16 (rows - 1)
    float tint, tintPerValue;  // place among the tints where f = 0, and what f adds to it
    float firstTint, lastTint;

    int columns() const { return static_cast<int>(lastPixels & 0xffff) + 1; }
    int rows() const { return static_cast<int>(lastPixels >> 16) + 1; }
    bool crossesLeast() const { return (flags & kCrossesLeast) != 0; }
    bool crossesMost() const { return (flags & kCrossesMost) != 0; }
    // Some of its rays may lie along a face.
    bool grazes() const { return (flags & kGrazes) != 0; }
    // A pixel's steps may have to be turned along it (cell::alongCell).
    bool mayBeFlat() const { return (flags & kMayBeFlat) != 0; }
    enum PieceFlag : std::uint32_t {
        kCrossesLeast = 1,
        kCrossesMost = 2,
        kGrazes = 4,
        kMayBeFlat = 8
    };
};
// The tiles that its pixels are in.
TileSpan spanOf(const CellView& view, const SeenPiece& c);
// Of one of that layer, with this field.
void takeTints(SeenPiece& c, const CellView& view, std::size_t layer, const RangeStyle& style,
               const cell::ColoredField& field);

// A CellSplat in a picture: two lines of the caches.
struct alignas(128) SeenCell : SeenPiece {
    float steep;  // CellView::steep as the gradient of f
    std::array<float, 3> at, ray, perSize;
    std::array<float, 8> f;
};
// As seeCells() writes it, one field of many at once: where each field is; tints come later.
namespace seen_cell {
constexpr std::size_t kFloats = sizeof(SeenCell) / sizeof(float);
constexpr std::size_t kBase = 0, kOx = 1, kOy = 2, kPerRange = 3, kLeast = 4, kMost = 5, kFlags = 6,
                      kX = 7, kY = 8, kLastPixels = 9, kTints = 10, kSteep = 14, kAt = 15,
                      kRay = 18, kPerSize = 21, kF = 24;
static_assert(kF + 8 == kFloats);
}  // namespace seen_cell

// A TetSplat in a picture.
struct SeenTet : SeenPiece {
    std::array<float, 4> at, ray, right, up;  // the corners' shares
    float f, fRay, fRight, fUp, across;       // of a pixel, a unit of depth away
    float widest;                             // ramp
};
// The gradient of f by which light falls on it.
struct alignas(64) TetSlopes {
    // As the shares: f a unit along each axis.
    struct Along {
        float at, ray, right, up;
    };
    std::array<Along, 3> along;
    std::array<float, 3> way;  // along the axes, of the ray at the centre, a unit of depth
    float steep;               // CellView::steep as the gradient of f
};
// None where the view does not see it. Where light falls on it, `slopes` are its.
std::optional<SeenTet> seenTet(const CellView& view, const ValuedTet& tet, std::size_t layer,
                               const RangeStyle& style, TetSlopes& slopes);

// Tetrahedra in a view, in the order in which they come.
struct SeenTets {
    std::vector<SeenTet> tets;
    std::vector<TetSlopes> slopes;  // of each, where light falls on them
    void clear() {
        tets.clear();
        slopes.clear();
    }
    // False where the view does not see it.
    bool add(const CellView& view, const ValuedTet& tet, std::size_t layer,
             const RangeStyle& style);
};

}  // namespace render
