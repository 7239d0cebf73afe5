// Where the leaves of an AMReX plotfile lie.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "timeseries/grid/grid.h"
#include "timeseries/readers/amrex/amrex_header.h"

namespace timeseries {

struct AmrexGrid {
    std::vector<std::vector<std::vector<bool>>> covered;  // as coveredCells()
    // Along axes, if that was asked for: of what the boxes of a single level fill. Of a mesh
    // nothing: its points are the leaves, level by level, box by box, x fastest.
    std::optional<IndexBox> whole;
    std::shared_ptr<const Grid> grid;
};
AmrexGrid amrexGridOf(const AmrexPlotfile& file, bool mayBeUpright);

}  // namespace timeseries
