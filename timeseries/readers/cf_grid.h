// The grid of a variable from its coordinate variables; where these cannot place the points, they
// are counted instead, and a note says so.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/grid.h"
#include "timeseries/readers/cf_axes.h"
#include "timeseries/readers/netcdf_file.h"

namespace timeseries {

// x, y, z; an axis the variable does not have is one point at index 0. `geographic`: the file's
// longitudes and latitudes of any rank. Throws FileError when coordinates cannot be read.
std::array<Axis, 3> axesOf(const NetcdfFile& file, const FileAxes& fileAxes,
                           const NcVariable& variable, const Roles& roles,
                           std::span<const NcVariable* const> geographic,
                           std::vector<std::string>& notes);

}  // namespace timeseries
