// Tables of scattered points (.csv and others): x, y and z, and a variable each further column.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "timeseries/readers/reader.h"

namespace timeseries {

bool isCsv(std::string_view start);
// The first of the paths. Throws FileError.
std::unique_ptr<Reader> openCsv(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
