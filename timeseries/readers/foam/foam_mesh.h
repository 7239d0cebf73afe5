// The mesh of an OpenFOAM case: faces between cells, of one part or several. OpenFOAM, "User
// Guide", 5.1 "Mesh description".
#pragma once

#include <span>

#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/foam/foam_case.h"

namespace timeseries {

struct FoamMesh {
    UnstructuredGrid grid;                     // of all parts, one behind the other
    std::vector<std::uint64_t> cells, points;  // of each part
};

// Throws FileError.
FoamMesh foamMeshOf(std::span<const FoamMeshFiles> parts);

}  // namespace timeseries
