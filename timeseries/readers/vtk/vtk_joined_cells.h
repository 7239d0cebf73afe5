// The cells of several VTK headers, one behind the other in the header of their whole.
#pragma once

#include <span>

#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

// Takes the cells of `parts` and their points, each part's numbered behind those of the part before
// it. Throws FileError when a cell names a point that its part has not, or all are too many.
void joinVtkCells(VtkHeader& whole, std::span<VtkHeader> parts);

}  // namespace timeseries
