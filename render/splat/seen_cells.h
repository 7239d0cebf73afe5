// Cells of a scene, many at once, as one view sees them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/model/cell_splat.h"
#include "render/model/scene.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/cell_slopes.h"
#include "render/splat/cell_view.h"
#include "render/splat/tile_bins.h"
#include "timeseries/grid/pages.h"

namespace render {

// Pieces that are looked at together: each kind of number of all of them lies in a row.
struct PieceBatch {
    static constexpr std::size_t kMost = 64;
    template <typename T>
    using Row = std::array<T, kMost>;

    std::size_t count = 0;
    std::array<Row<double>, 3> from{}, to{};
    std::array<Row<double>, 8> corners{};
    Row<double> lo{}, hi{};
    Row<std::uint8_t> layer{}, octant{};
    Row<std::uint32_t> cell{};

    bool isFull() const { return count == kMost; }
    // REQUIRES: !isFull().
    void add(const ValuedCell& piece, const CellOfLayer& of, unsigned inOctant) {
        for (std::size_t a = 0; a < 3; ++a) {
            from[a][count] = piece.from[static_cast<int>(a)];
            to[a][count] = piece.to[static_cast<int>(a)];
        }
        for (std::size_t c = 0; c < 8; ++c) corners[c][count] = piece.corners[c];
        lo[count] = piece.lo;
        hi[count] = piece.hi;
        layer[count] = of.layer;
        octant[count] = static_cast<std::uint8_t>(inOctant);
        cell[count++] = of.cell;
    }
};

// What cellSplatAt() of render/model/cell_splat.h says of each: those that the view sees something
// of are added to `cells`, and the tiles that they touch to `spans`; where light falls on them,
// `slopes` have theirs, of these points.
void seeCells(const CellView& view, const Scene& scene, const PointSlopes* points,
              const PieceBatch& pieces, timeseries::PageVector<SeenCell>& cells,
              timeseries::PageVector<CellSlopes>& slopes, std::vector<TileSpan>& spans);

}  // namespace render
