// Cells of an upright grid and what is seen of them, many at once.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "render/splat/cell_pieces.h"
#include "render/splat/seen_cells.h"
#include "timeseries/grid/grid.h"

namespace render {

// The scene must outlive it.
class CellBatches {
 public:
    explicit CellBatches(const Scene& scene);

    // What forEachPiece() passes is added to `pieces`, which use() is to take away: each time that
    // they may have no room for more, and at the end. REQUIRES: not of a mesh.
    void forEach(std::span<const CellOfLayer> cells, PieceBatch& pieces,
                 const std::function<void()>& use) const;
    // Null where no light falls on them.
    const PointSlopes* slopes() const { return slopes_ ? &*slopes_ : nullptr; }

 private:
    // Of a cell along an axis: between which places it lies, and what the points at both ends add
    // to an index.
    struct Side {
        double from, to;
        std::uint32_t low, high;
    };
    template <typename T>
    bool addWhole(std::span<const T> values, std::span<const CellOfLayer> cells,
                  std::span<const CellOfLayer> later, PieceBatch& pieces) const;
    template <typename T>
    void prefetch(std::span<const T> values, std::uint32_t cell) const;

    const Scene& scene_;
    std::optional<PointSlopes> slopes_;
    timeseries::IndicesAlong indices_;
    std::array<std::vector<Side>, 3> sides_;
    // So many cells are added together where all are whole, as so many pieces; none where cells of
    // the scene may all be in parts.
    std::size_t together_ = 0, most_ = 0;
};

}  // namespace render
