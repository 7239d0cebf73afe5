// FITS images (.fits): cubes of the sky, in as many HDUs as the file has, plain or compressed by
// tiles.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

// REQUIRES: one path. Throws FileError.
std::unique_ptr<Reader> openFits(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
