// NetCDF files, classic and NetCDF-4, by the CF conventions.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

// Several files are one series, joined along time. REQUIRES: paths not empty. Throws FileError.
std::unique_ptr<Reader> openNetcdf(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
