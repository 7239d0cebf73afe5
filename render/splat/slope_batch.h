// Slopes of cells, and those of many worked out together.
#pragma once

#include <array>
#include <cstddef>

namespace render {

// Of a piece of a cell whose field is reference + extent f, what f changes over the piece's size
// along each axis: the coefficients of each, as those of CellSplat::f.
using CellSlopes = std::array<std::array<float, 8>, 3>;
constexpr float kMostSlope = 1e9f;  // at a corner: its square is a float

// Of whole cells, many at once: each kind of number of all of them lies in a row.
struct SlopeBatch {
    static constexpr std::size_t kMost = 64;
    using Row = std::array<double, kMost>;

    std::size_t count = 0;
    // Along each axis: at each corner half of what the values after and before it differ by, and
    // what makes slopes of that, of a corner at the lower and at the upper end.
    std::array<std::array<Row, 8>, 3> difference{};
    std::array<std::array<Row, 2>, 3> scale{};

    // Writes count of them from `to` on; those of which isNone is not 0 have a difference that is
    // no number.
    void take(CellSlopes* to, Row& isNone) const;
};

}  // namespace render
