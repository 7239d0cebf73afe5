// Whether the steps of a list of VTK files have one grid: by what their headers count, and the
// cells of the last.
#pragma once

#include <span>

#include "timeseries/grid/step_grids.h"
#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

// `first` is the grid of the first. Nothing of a member that cannot be read, which is told when its
// step is.
StepGrids vtkStepGrids(std::span<const VtkMember> members, const Grid& first);

}  // namespace timeseries
