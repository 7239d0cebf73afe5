// Adaptive meshes of lattices: levels of boxes of cells, each of cells some whole times as fine as
// those of the level before, that lie over each other (M. J. Berger, P. Colella, Local adaptive
// mesh refinement for shock hydrodynamics, 1989). What no finer level covers are the leaves.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/index_boxes.h"

namespace timeseries {

struct LatticeLevel {
    IndexBox domain;  // the same space at each level, in its own cells
    std::vector<IndexBox> boxes;
};

// What keeps the leaves from filling once what the boxes of the first level do, in words; "" when
// nothing does: domains that do not refine each other, boxes that leave theirs or have a cell in
// common, and those that cover parts of cells of the level before, or lie where it has none.
// REQUIRES: no domain or box is empty, indices within 2^31, fewer than 2^32 cells.
std::string flawOf(std::span<const LatticeLevel> levels);

// [level][box]: which of the cells, x fastest, a box of the next level covers; empty where none is.
// REQUIRES: no flaw.
std::vector<std::vector<std::vector<bool>>> coveredCells(std::span<const LatticeLevel> levels);

}  // namespace timeseries
