#include "timeseries/grid/without_cells.h"

#include <algorithm>
#include <iterator>

namespace timeseries {

UnstructuredGrid withoutCells(const UnstructuredGrid& grid, const std::vector<bool>& leftOut) {
    UnstructuredGrid kept;
    kept.points = grid.points;
    kept.levels = grid.levels;
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        if (leftOut[cell]) continue;
        kept.types.push_back(grid.types[cell]);
        std::ranges::copy(listOf(grid.corners, grid.ends, cell), std::back_inserter(kept.corners));
        kept.ends.push_back(kept.corners.size());
        if (grid.faceEnds.empty()) continue;
        std::ranges::copy(listOf(grid.faces, grid.faceEnds, cell), std::back_inserter(kept.faces));
        kept.faceEnds.push_back(kept.faces.size());
    }
    return kept;
}

Mesh meshOfPointsWithout(const std::vector<bool>& ghosts, const UnstructuredGrid& grid,
                         const UnstructuredShapes& shapes) {
    if (std::ranges::find(ghosts, true) == ghosts.end()) return meshOfPoints(grid, shapes);
    const UnstructuredGrid own = withoutCells(grid, ghosts);
    return meshOfPoints(own, UnstructuredShapes(own));
}

}  // namespace timeseries
