// Where a tile of a picture is summed.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/splat/tile_layout.h"

namespace render {

// So many splats or cells are summed between two looks whether their tile is closed.
constexpr std::size_t kBetweenLooks = 512;

// A tile's pixels while they are summed, and the tables of its rays: rows of kTileStride floats, of
// which those beside the tile mean nothing. One a thread.
constexpr int kTileStride = kTileWidth + 16;
struct TileRoom {
    explicit TileRoom(const TileLayout& layout);
    // Makes it that tile's, its sums as they were left. `opaqueDepth` is the picture's, a pixel
    // each, or none.
    void enter(const TileLayout& layout, std::size_t tile, std::span<const float> opaqueDepth,
               int pictureWidth);

    // Of Over: nothing that comes later is seen anywhere in the tile.
    bool isClosed() const;

    glm::ivec2 at{0}, size{0};  // in the box
    // Channels one after another, `plane` floats each.
    std::vector<float> sums;
    std::size_t plane = 0;
    // What sums are to be multiplied by; Over has it in them.
    std::vector<float> factor;
    float largestFactor = 1;
    std::vector<float> perRay2;  // 1 / |ray / a|^2, where splats are even
    std::vector<float> opaque;
    float nearestOpaque = 1;
};

// Four channels, `plane` floats apart, times a pixel's factor if there are any, into pixels.
void interleaveRow(const float* sums, std::size_t plane, const float* factor, std::size_t width,
                   float* to);

}  // namespace render
