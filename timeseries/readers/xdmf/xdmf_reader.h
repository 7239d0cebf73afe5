// XDMF files (.xdmf, .xmf): grids of any kind that XML describes, whose values lie elsewhere, in
// HDF5 most of all.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "timeseries/readers/reader.h"

namespace timeseries {

bool isXdmf(std::string_view start);
// The first of the paths. Throws FileError.
std::unique_ptr<Reader> openXdmf(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
