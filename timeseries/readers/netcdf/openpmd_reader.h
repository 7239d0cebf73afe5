// openPMD files in HDF5 (.h5): meshes along axes and scattered particles, of one iteration or many.
#pragma once

#include <memory>

#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// REQUIRES: isOpenPmd. Throws FileError.
std::unique_ptr<Reader> openOpenPmd(std::unique_ptr<NetcdfFile> file);

}  // namespace timeseries
