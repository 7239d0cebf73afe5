// The arrays of a VTKHDF file at points or cells: Kitware, "VTK File Formats", "VTKHDF".
#pragma once

#include <string>
#include <vector>

#include "timeseries/readers/netcdf/netcdf_file.h"

namespace timeseries {

inline constexpr const char *kVtkHdfGhosts = "vtkGhostType",
                            *kVtkHdfMissing = "ghost and blanked, by vtkGhostType";

// "VTKHDF/PointData/"
std::string vtkHdfGroup(bool atPoints);
// Null when there are none.
const NcVariable* vtkHdfGhosts(const NcHeader& header, bool atPoints);
// "v"; "v (points)" where there is one at cells, too.
std::string vtkHdfName(const NcHeader& header, const std::string& own, bool atPoints);
// Which points or cells the ghosts' flags say are none.
std::vector<bool> vtkHdfMissing(const Values& flags, bool atPoints);

}  // namespace timeseries
