// Grids of 4 x 3 x 5 bricks that are bent inside the same box, as tests::bent has it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/raised.h"

namespace tests {

inline std::shared_ptr<const timeseries::Grid> bentGrid(Cut cut) {
    return gridOf(atPoints(bentBricks(cut)));
}

inline std::shared_ptr<const timeseries::Grid> bentCurvilinear() {
    return curvilinear({5, 4, 6}, [](double i, double j, double k) { return bent(i, j, k); });
}

// Columns above a lattice, of levels that are bent inside the same box.
inline std::shared_ptr<const timeseries::Grid> bentColumns() {
    const auto flat = bricks({5, 4, 1}, Cut::Hexahedra, bent);
    timeseries::UnstructuredGrid squares;
    squares.points = flat.points;
    auto feet = std::make_shared<std::vector<timeseries::SolidCells::Foot>>();
    for (std::uint32_t j = 0; j < 3; ++j)
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t first = i + 5 * j;
            addCell(squares, 9, {first, first + 1, first + 6, first + 5});
            feet->push_back({first, first + 1, first + 6});
            feet->push_back({first, first + 6, first + 5});
        }
    auto prisms = meshOfPoints(squares, timeseries::UnstructuredShapes(squares), {0, 1});
    prisms.setSolids(timeseries::SolidCells::ofColumns(feet, 20, 2, {1, 1, 1}));
    std::vector<double> heights;
    for (int k = 0; k < 6; ++k)
        for (int c = 0; c < 20; ++c) heights.push_back(bent(c % 5, c / 5, k).z);
    return gridOf(raised(prisms, heights));
}

// Of solid cells, whose points have the values, of each kind.
inline std::vector<std::shared_ptr<const timeseries::Grid>> bentSolids() {
    std::vector<std::shared_ptr<const timeseries::Grid>> grids;
    for (const Cut cut : kCuts) grids.push_back(bentGrid(cut));
    grids.push_back(bentColumns());
    return grids;
}
// Of those that have the values themselves.
inline std::vector<std::shared_ptr<const timeseries::Grid>> bentCells() {
    std::vector<std::shared_ptr<const timeseries::Grid>> grids;
    for (const Cut cut : kCuts) grids.push_back(gridOf(atCells(bentBricks(cut))));
    return grids;
}
inline std::vector<std::shared_ptr<const timeseries::Grid>> bentMeshes() {
    auto grids = bentSolids();
    for (auto& cells : bentCells()) grids.push_back(std::move(cells));
    grids.push_back(bentCurvilinear());
    return grids;
}

}  // namespace tests
