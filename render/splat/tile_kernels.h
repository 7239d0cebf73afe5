// What is done with many splats at once, for every processor that the program may meet: Highway
// chooses among the targets when the program runs. A splat's arithmetic does not depend on which
// others are beside it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/splat/tile_bins.h"
#include "render/splat/tile_room.h"
#include "render/splat/tile_view.h"

namespace render {

// Splats in the order in which they are summed: grid indices, or their places among a mesh's, and
// places among the tints, none for Weight.
struct SplatList {
    std::vector<std::uint32_t> index;
    std::vector<float> tint;
    std::vector<SeenSplat> seen = {};
};

// Not of a mesh. Of the splats [first, last) of the list, into the same places.
void findTiles(const TileView& view, const SplatList& list, std::size_t first, std::size_t last,
               std::span<TileSpan> spans);

// Adds splats, in this order; Over: each before those that come later. Tints as in SplatList.
void sumTile(const TileView& view, std::span<const std::uint32_t> index,
             std::span<const float> tints, TileRoom& room);

}  // namespace render
