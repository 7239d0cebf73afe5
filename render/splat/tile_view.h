// A scene in one view, as the kernels of tile_kernels.h take it: plain numbers in the types that
// they compute in. The formulas are those of render/model/footprint.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/model/covered.h"
#include "render/model/scene.h"

namespace render {

// Tiles are numbered row by row from the lower left corner of `box`.
struct TileView {
    // `layer` is the plane's for Weight and WeightedColor; Over takes them all. REQUIRES: no long
    // cells (PlacedPoints::longCells). The placed points must outlive it.
    TileView(const Scene& scene, const View& view, Channels channels, std::size_t layer);

    Channels channels;
    PixelBox box;
    glm::ivec2 tile, tiles;  // size of one, and how many along each side
    // The grid: positions and side lengths of cells along each axis, in axis coordinates.
    std::array<double, 3> size;
    std::array<const double*, 3> position;
    std::array<std::vector<float>, 3> roughPosition, width;
    std::array<std::array<double, 3>, 4> viewFromAxes;  // columns
    std::array<std::int32_t, 3> clipLo, clipHi;
    bool clips;
    // The projection. Window positions are counted from the box's corner; the depth in the depth
    // buffer is depthA / z + depthB.
    std::array<double, 2> focal, centre;
    float near;
    double depthA, depthB;
    // Rays in axis coordinates, and the squares of a pixel's x / -z and y / -z.
    std::array<float, 3> axis, perPixelX, perPixelY;
    std::array<float, 2> slope2;
    // Semi-axes are `kernel` times a cell's sides, at least `least` a unit of depth; the outline of
    // the largest reaches as far as that of a sphere of `reach` times as much.
    float kernel, least, reach;
    // All splats have these semi-axes, or those of cubes as `least` makes them: |ray / a| depends
    // on the pixel alone then.
    bool even;
    std::array<float, 3> semiAxes;
    // Of an even splat, or of one whose cell's volume is 1.
    float weight;
    int pointSide;  // 0: no point splats
    // Linear colours, and what a splat's W is multiplied by: the tints of all layers. Empty for
    // Weight, whose factor is in `weight`.
    std::vector<std::array<float, 4>> tints;
    // A layer's tints are [first, first + span], at places between them interpolated.
    struct Tints {
        float first, span;
    };
    std::vector<Tints> tintsOf;

 private:
    void takeGrid(const Scene& scene, const View& view);
    void takeFootprint(const Scene& scene, const PointsView& seen, const View& view);
    void takeTints(const Scene& scene, std::size_t layer);
};

// Of a tile, in the box.
inline glm::ivec2 cornerOf(const TileView& view, std::size_t tile) {
    return glm::ivec2(static_cast<int>(tile) % view.tiles.x,
                      static_cast<int>(tile) / view.tiles.x) *
           view.tile;
}

// Where the tint of a value of this layer stands.
inline float tintPlace(const TileView& view, std::size_t layer, const RangeStyle& style,
                       double value) {
    const TileView::Tints& of = view.tintsOf[layer];
    const auto* byValue = std::get_if<ByValue>(&style.color);
    return byValue ? of.first + of.span * static_cast<float>(mapPosition(*byValue, value))
                   : of.first;
}

}  // namespace render
