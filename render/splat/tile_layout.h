// A picture cut into tiles, and the rays of its pixels, as the kernels of tile_kernels.h and
// cell_kernels.h take them: plain numbers in the types that they compute in.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "render/model/covered.h"
#include "render/model/footprint.h"
#include "render/model/scene.h"

namespace render {

constexpr int kTileWidth = 64;

inline std::array<float, 3> floats(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// The same picture with so many rays across each of its pixels as pixels of their own.
View finer(View view, int raysAcross);

// Tiles are numbered row by row from the lower left corner of `box`. What is called a pixel here is
// a ray's share of one.
struct TileLayout {
    // `seen`: the finer view.
    TileLayout(const Scene& scene, const View& view, const PointsView& seen, Channels channels,
               int raysAcross = 1);

    Channels channels;
    int raysAcross;
    PixelBox pixels;         // of the picture
    PixelBox box;            // the same, in rays
    glm::ivec2 tile, tiles;  // size of one, and how many along each side
    // The projection. Window positions are counted from the box's corner; the depth in the depth
    // buffer is depthA / z + depthB.
    std::array<double, 2> focal, centre;
    float near;
    double depthA, depthB;
    // Rays in axis coordinates, and the squares of a pixel's x / -z and y / -z.
    std::array<float, 3> axis, perPixelX, perPixelY;
    std::array<float, 2> slope2;
    // All splats have these semi-axes, or those of cubes as `least` makes them: |ray / a| depends
    // on the pixel alone then.
    bool even = false;
    std::array<float, 3> semiAxes{};
    // Linear colours, and what a splat's W is multiplied by: the tints of all layers. Empty for
    // Weight and Count.
    std::vector<std::array<float, 4>> tints;
    // A layer's tints are [first, first + span], at places between them interpolated.
    struct Tints {
        float first, span;
    };
    std::vector<Tints> tintsOf;
    std::vector<std::array<float, 4>> tintSums;  // sumsOf() a layer's

    std::size_t count() const {
        return static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y);
    }

 private:
    void takeTints(const Scene& scene);
};

// Of a tile, in the box.
inline glm::ivec2 cornerOf(const TileLayout& layout, std::size_t tile) {
    return glm::ivec2(static_cast<int>(tile) % layout.tiles.x,
                      static_cast<int>(tile) / layout.tiles.x) *
           layout.tile;
}

}  // namespace render
