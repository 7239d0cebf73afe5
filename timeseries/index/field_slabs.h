// A step's values in the grid's order, a part at a time: for those who go through all of them once,
// and would not have room for them at once.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "timeseries/grid/field.h"
#include "timeseries/index/sorted_step.h"

namespace timeseries {

// Cells along the last index of a grid, as CellCorners numbers them, and the values of the points
// that these lie between. Refers to the values, which must outlive it.
struct FieldSlab {
    // All of it.
    FieldSlab(const Field& whole)  // NOLINT(google-explicit-constructor): a field is a slab, too
        : values(whole), points(whole.grid->size()), endCell(points[2] + 1) {}
    // The cells [first, end) of a grid of so many points; `planes` has the values of the points of
    // plane `plane` and on. REQUIRES: those of all corners of these cells.
    FieldSlab(const Field& planes, const std::array<std::size_t, 3>& size, std::size_t plane,
              std::size_t first, std::size_t end)
        : values(planes), points(size), firstPlane(plane), firstCell(first), endCell(end) {}

    // In `values`, of a point of the grid.
    std::size_t indexOf(std::size_t x, std::size_t y, std::size_t z) const {
        return x + points[0] * (y + points[1] * (z - firstPlane));
    }

    const Field& values;
    std::array<std::size_t, 3> points;  // of the grid, along its indices
    std::size_t firstPlane = 0;
    std::size_t firstCell = 0, endCell;
};

inline constexpr std::size_t kSlabBytes = std::size_t{16} << 20;
inline constexpr std::size_t kAllAtOnce = ~std::size_t{0};

// use(slab) of one slab of so many bytes after another, together all cells, for as long as it
// returns true: the same ones wherever the values come from, which is memory where the field is
// held, else the step's source, of which parts are read where that is no more work than reading
// all. Of points that have places of their own all at once, as a field with a grid. Throws as
// SortedStep::field().
void forEachSlab(const SortedStep& step, const std::function<bool(const FieldSlab&)>& use,
                 std::size_t bytes = kSlabBytes);

}  // namespace timeseries
