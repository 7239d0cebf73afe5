// Zarr hierarchies of versions 2 and 3, in folders and zip files, by the conventions of xarray
// (which are CF's) and of OME-NGFF.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

// Several are one series, joined along time. REQUIRES: isZarr() of each (zarr_hierarchy.h); paths
// not empty. Throws FileError.
std::unique_ptr<Reader> openZarr(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
