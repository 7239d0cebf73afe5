// Several files of one format as one series, for formats whose files are opened one by one.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

using OpenOne = std::function<std::unique_ptr<Reader>(const std::filesystem::path&)>;

// The steps of all files, in the order of the paths. Each file is opened once here, for what it
// says of itself, and again when a step of it is read; few stay open.
// Times are the files' own where all files have them, in the same units, and they ascend from file
// to file; else, with one step a file, the numbers in which the names differ; else steps are
// counted. Why the files' own are not taken is a note. REQUIRES: paths is not empty.
// Throws FileError, naming two files, where variables, types, units or grids differ, and where
// times of files of several steps overlap.
std::unique_ptr<Reader> openSequence(std::span<const std::filesystem::path> paths, OpenOne openOne);

}  // namespace timeseries
