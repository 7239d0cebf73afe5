// The cells of a mesh that lists faces between them, as cells that name their corners.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "timeseries/grid/unstructured.h"

namespace timeseries {

// Faces, and the cells at their two sides; kNoPoint, or nothing at the list's end, for none.
struct FacesOfCells {
    std::vector<std::uint64_t> ends;     // of each face in `corners`
    std::vector<std::uint32_t> corners;  // points
    std::vector<std::uint32_t> owner;    // [faces]: a cell
    std::vector<std::uint32_t> neighbour;

    std::uint64_t cells() const;  // the greatest number of one, and 1
};

// Adds them with points that are numbered from `firstPoint` on: tetrahedra, pyramids, wedges and
// hexahedra as such, others as polyhedra. The first thing that is wrong, in a few words, or "".
// REQUIRES: as many ends as owners, no fewer than neighbours; all corners name points that there
// are.
std::string addCells(FacesOfCells faces, std::uint32_t firstPoint, UnstructuredGrid& grid);

}  // namespace timeseries
