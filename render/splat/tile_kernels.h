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

// Of the points of these grid indices, into the same places; what they are for sumTile() takes the
// place of the indices. REQUIRES: none that are seen before (TileView).
void findTiles(const TileView& view, std::span<std::uint32_t> points, std::span<TileSpan> spans);

// Adds splats, in this order; Over: each before those that come later: as findTiles() leaves them,
// or places among those that were seen before; and places among the tints, none for Weight and
// Count.
void sumTile(const TileView& view, std::span<const std::uint32_t> points,
             std::span<const float> tints, TileRoom& room);

}  // namespace render
