// As cell_kernels.h, of tetrahedra. The formulas are those of render/model/tet_splat.h.
#pragma once

#include <cstdint>
#include <span>

#include "render/splat/cell_view.h"
#include "render/splat/tile_room.h"

namespace render {

// Adds tetrahedra in this order, of which `which` says; Over: each before those that come later.
void sumTets(const CellView& view, const SeenTets& tets, std::span<const std::uint32_t> which,
             TileRoom& room);

}  // namespace render
