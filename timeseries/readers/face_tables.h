// The faces of polyhedra as tables, in which each stands once for the cells at its two sides: VTK
// since 9.4, in XML and HDF5.
#pragma once

#include <cstdint>
#include <vector>

#include "timeseries/grid/unstructured.h"

namespace timeseries {

struct FaceTables {
    std::vector<std::uint32_t> corners;   // of each face, one behind the other: the grid's points
    std::vector<std::uint64_t> ends;      // [face]: where its corners end
    std::vector<std::uint64_t> faces;     // of each cell: which they are
    std::vector<std::uint64_t> cellEnds;  // [cell]: where its faces end; of no polyhedron, at once
};

// As the grid's lists, for its last cells, as many as the tables have. A face is taken for two of
// them at most: a damaged file might name a large one for many. What is wrong has no point.
void addFaces(const FaceTables& tables, UnstructuredGrid& grid);

}  // namespace timeseries
