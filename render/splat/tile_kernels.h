// What is done with many splats at once, for every processor that the program may meet: Highway
// chooses among the targets when the program runs. A splat's arithmetic does not depend on which
// others are beside it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/splat/tile_view.h"

namespace render {

// Splats in the order in which they are summed: grid indices, and places among the tints, none for
// Weight.
struct SplatList {
    std::vector<std::uint32_t> index;
    std::vector<float> tint;
};

// The tiles that a splat may touch: from this one on so many columns and rows; none when it is not
// drawn.
struct TileSpan {
    std::uint32_t first;
    std::uint16_t columns, rows;
};
template <typename Visit>
void forEachTile(const TileSpan& span, int across, const Visit& visit) {
    std::uint32_t tile = span.first;
    for (unsigned row = 0; row < span.rows; ++row, tile += static_cast<std::uint32_t>(across))
        for (unsigned column = 0; column < span.columns; ++column) visit(tile + column);
}
// Of the splats [first, last) of the list, into the same places.
void findTiles(const TileView& view, const SplatList& list, std::size_t first, std::size_t last,
               std::span<TileSpan> spans);

// A tile's pixels while they are summed, and the tables of its rays: rows of kTileStride floats, of
// which those beside the tile mean nothing. One a thread.
constexpr int kTileWidth = 64, kTileStride = kTileWidth + 16;
struct TileRoom {
    explicit TileRoom(const TileView& view);
    // Makes it that tile's, its sums as they were left. `opaqueDepth` is the picture's, a pixel
    // each, or none.
    void enter(const TileView& view, std::size_t tile, std::span<const float> opaqueDepth,
               int pictureWidth);

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

// Adds splats, in this order; Over: each before those that come later. Tints as in SplatList.
void sumTile(const TileView& view, std::span<const std::uint32_t> index,
             std::span<const float> tints, TileRoom& room);

}  // namespace render
