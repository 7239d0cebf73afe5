// The time of a VTK XML file, without VTK.
#pragma once

#include <optional>

#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

struct VtkTold {
    std::optional<VtkTime> time;  // as VtkFrame's
    bool byVtkAlone = false;      // the file has to be opened for its time
};
// Of the file's own field data, also where it names others, which may have theirs. Throws
// FileError.
VtkTold vtkTimeOf(const XmlFile& file);

}  // namespace timeseries
