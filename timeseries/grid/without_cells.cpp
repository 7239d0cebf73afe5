#include "timeseries/grid/without_cells.h"

#include <algorithm>
#include <iterator>
#include <utility>

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

std::vector<bool> pointsOfGhosts(std::vector<bool> ghosts,
                                 const std::array<std::uint64_t, 3>& points) {
    if (std::ranges::find(ghosts, true) == ghosts.end()) return {};
    // From cells to the points between them, one axis after another.
    std::uint64_t stride = 1;
    for (const std::uint64_t count : points) {
        if (count > 1) {
            const std::uint64_t cells = count - 1, lines = ghosts.size() / (stride * cells);
            std::vector<bool> both;
            both.reserve(lines * count * stride);
            for (std::uint64_t line = 0; line < lines; ++line)
                for (std::uint64_t i = 0; i < count; ++i)
                    for (std::uint64_t k = 0; k < stride; ++k) {
                        const std::uint64_t after = (line * cells + i) * stride + k;
                        both.push_back((i == 0 || ghosts[after - stride]) &&
                                       (i == cells || ghosts[after]));
                    }
            ghosts = std::move(both);
        }
        stride *= count;
    }
    return ghosts;
}

std::vector<bool> pointsOfGhosts(const std::vector<bool>& ghosts, const UnstructuredGrid& grid) {
    if (std::ranges::find(ghosts, true) == ghosts.end()) return {};
    std::vector<bool> points(grid.points.size());
    for (const bool ofGhosts : {true, false})
        for (std::size_t cell = 0; cell < ghosts.size(); ++cell) {
            if (ghosts[cell] != ofGhosts) continue;
            for (const std::uint32_t corner : listOf(grid.corners, grid.ends, cell))
                points[corner] = ofGhosts;
        }
    return points;
}

void leaveOut(const std::vector<bool>& more, std::vector<bool>& missing) {
    if (missing.empty()) missing = more;
    for (std::size_t i = 0; i < more.size(); ++i)
        if (more[i]) missing[i] = true;
}

}  // namespace timeseries
