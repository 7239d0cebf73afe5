// The cells of an XML file in which their lists stand as they are in memory: read by all threads,
// without VTK.
#pragma once

#include <optional>

#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

// With their points. Nothing where a list stands otherwise, or cells list faces. Throws FileError.
std::optional<UnstructuredGrid> rawVtkCells(const VtkHeader& header);

}  // namespace timeseries
