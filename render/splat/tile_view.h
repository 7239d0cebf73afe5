// A scene of points in one view, as the kernels of tile_kernels.h take it. The formulas are those
// of render/model/footprint.h.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/splat/seen_splat.h"
#include "render/splat/tile_layout.h"

namespace render {

// `layer` is the plane's for Weight and WeightedColor; Over and Count take them all. The placed
// points must outlive it.
struct TileView : TileLayout {
    TileView(const Scene& scene, const View& view, Channels channels, std::size_t layer,
             int raysAcross = 1);

    // The grid: positions and side lengths of cells along each axis, in axis coordinates.
    std::array<double, 3> size;
    std::array<const double*, 3> position;
    std::array<std::vector<float>, 3> roughPosition, width;
    using Columns = std::array<std::array<double, 3>, 4>;
    Columns viewFromAxes;
    // Where points are evenly spaced along each axis, their indices take the place of positions.
    bool evenlySpaced = false;
    Columns viewFromIndices;
    // Where they fit, a point's indices along the axes stand in one word, x lowest, from these bits
    // on; else it has its linear index.
    bool packs = false;
    int yAt, zAt;
    std::array<std::int32_t, 3> clipLo, clipHi;
    bool clips;
    // Semi-axes are `kernel` times a cell's sides, at least `least` a unit of depth.
    float kernel, least;
    // All splats are even spheres, which are seen as if `reach` times as large.
    bool spheres = false;
    float reach;
    // n of an even splat, but for its depth^2: polynomials of its centre's distance from the view
    // axis. xx: y^0 to y^2; yy: x^0 to x^2; xy: 1, x, y and x y.
    std::array<float, 3> nxx, nyy;
    std::array<float, 4> nxy;
    // Of an even splat, or of one whose cell's volume is 1; for Weight, of as many points as it
    // stands for.
    float weight;
    int pointSide;  // 0: no point splats
    // Splats are worked out before (SeenSplats), instead of by all that the grid tells: of a mesh,
    // and where cells are long. Indices are then places among these.
    bool isSeenBefore = false;
    std::span<const SeenSplat> seenSplats = {};
    bool endsAtFaces = false;
    std::span<const SplatCut> cuts = {};  // of each, if so
    // Where they are seen one by one, as these; else what stands in Mesh::Stored in axis
    // coordinates.
    std::optional<PointsView> oneByOne = {};
    std::array<double, 3> meshScale, meshOffset;
    double levelScale;
    bool hasLevels = false, hasHeights = false;

 private:
    TileView(const Scene& scene, const View& view, const PointsView& seen, Channels channels,
             std::size_t layer, int raysAcross);
    void takeMesh(const PlacedPoints& placed);
    void takeGrid(const Scene& scene);
    void takePlaces();
    void takeEvenForm(const PointsView& seen);
    void takeFootprint(const Scene& scene, const PointsView& seen, const View& view);
};

// Where the tint of a value of this layer stands.
inline float tintPlace(const TileView& view, std::size_t layer, const RangeStyle& style,
                       double value) {
    const TileView::Tints& of = view.tintsOf[layer];
    const auto* byValue = std::get_if<ByValue>(&style.color);
    return byValue ? of.first + of.span * static_cast<float>(mapPosition(*byValue, value))
                   : of.first;
}

}  // namespace render
