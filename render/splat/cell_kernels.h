// What is done with the cells of an interval volume, a tile of a picture at a time, for every
// processor that the program may meet (Highway). The formulas are those of
// render/model/cell_splat.h and render/model/light.h.
#pragma once

#include <cstdint>
#include <span>

#include "render/splat/cell_slopes.h"
#include "render/splat/cell_view.h"
#include "render/splat/tile_room.h"

namespace render {

// Adds cells in this order, of which `which` says; Over: each before those that come later. Where
// light falls on them, each has its slopes.
void sumCells(const CellView& view, std::span<const SeenCell> cells,
              std::span<const CellSlopes> slopes, std::span<const std::uint32_t> which,
              TileRoom& room);

}  // namespace render
