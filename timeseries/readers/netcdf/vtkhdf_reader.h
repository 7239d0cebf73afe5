// VTKHDF files (.vtkhdf, .hdf): unstructured grids and polygons, in parts and in time, and images.
#pragma once

#include <memory>

#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// REQUIRES: isVtkHdf. Throws FileError.
std::unique_ptr<Reader> openVtkHdf(std::unique_ptr<NetcdfFile> file);

}  // namespace timeseries
