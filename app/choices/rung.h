// The ways to draw a selection among which a picture that moves has to choose. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "app/choices/explorer.h"

namespace app {

// Cells, or one of so many points; in the picture's pixels, or in so many of them across.
struct Rung {
    Model model = Model::Cells;
    std::uint32_t stride = 1;  // of cells 1: they have no subsets
    int across = 1;
    bool isWhole() const { return stride == 1 && across == 1; }
    friend bool operator==(const Rung&, const Rung&) = default;
};

// Pixels are at most so coarse: a quarter of the work that grows with them, and text stays as it
// is.
constexpr int kCoarse = 2;

// What a user may fix, and whose error is told, are at least one of so many points.
constexpr std::uint32_t kFewestMoving = 16;

// Squares of so many pixels are as large in coarse ones: they would be others.
inline bool mayBeCoarse(const render::Footprint& footprint) {
    return footprint.kernel != render::Kernel::Point;
}

struct LadderOf {
    bool cells = true;         // they are there to be drawn
    bool points = true;        // they are, too
    bool coarse = true;        // pixels may be
    bool coarsePoints = true;  // those of points, too
    std::uint32_t mostStride = kFewestMoving;
};
// From the truest to the soonest: cells, points, ever fewer of them, each in the picture's pixels,
// then in coarse ones, which lose less in the time that they save (tests/bench/NOTES.md). Cells
// keep light and order on every rung: they cost a tenth, and a picture that changes its colours as
// it moves is another picture. Points that stand for cells have no light, and keep their order
// where that shows (app/drawing/moving_rung.cpp).
std::vector<Rung> ladder(const LadderOf& of);

// Whether it draws less than the other.
bool drawsLess(const Rung& a, const Rung& b);

// Of a ladder the part from that rung on, or where it has none such, what draws no more; the last
// where all draw more.
std::vector<Rung> from(const Rung& most, std::vector<Rung> rungs);

}  // namespace app
