// Zarr stores in zip files (PKWARE's APPNOTE 6.3), as zarr's ZipStore and zip itself write them:
// members that are stored or deflated, of any size.
#pragma once

#include <filesystem>
#include <memory>

#include "timeseries/readers/zarr/zarr_store.h"

namespace timeseries {

// Whether it begins as a zip file does that has members.
bool isZip(const std::filesystem::path& path);

// Of members of one name the last counts, as of Python's. Throws FileError.
std::unique_ptr<ZarrStore> zarrZip(const std::filesystem::path& path);

}  // namespace timeseries
