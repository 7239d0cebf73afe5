// Exodus II: the results of finite elements, at nodes and at elements.
#pragma once

#include <memory>

#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// REQUIRES: isExodus(). Throws FileError.
std::unique_ptr<Reader> openExodus(std::unique_ptr<NetcdfFile> file);

}  // namespace timeseries
