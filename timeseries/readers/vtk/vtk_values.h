// The values of arrays that VTK has read, and which of them are missing.
#pragma once

#include <vector>

#include "timeseries/readers/strided_layout.h"
#include "timeseries/readers/vtk/vtk_library.h"

class vtkDataArray;

namespace timeseries {

// As readVtkArray() takes them. REQUIRES: `stored` is of the array's type and as long as it.
void takeVtkValues(vtkDataArray& stored, const VtkArray& array, VtkPart part,
                   const StridedLayout& layout, Field& field);
// Empty where none is missing.
void takeVtkGhosts(vtkDataArray& ghosts, VtkPlace place, const StridedLayout& layout,
                   std::vector<bool>& missing);

}  // namespace timeseries
