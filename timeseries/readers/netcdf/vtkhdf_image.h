// VTKHDF files of images, also in time: Kitware, "VTK File Formats", "VTKHDF", "ImageData".
#pragma once

#include <memory>

#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

bool isVtkHdfImage(const NcHeader& header);

// REQUIRES: isVtkHdfImage. Throws FileError.
std::unique_ptr<Reader> openVtkHdfImage(std::unique_ptr<NetcdfFile> file);

}  // namespace timeseries
