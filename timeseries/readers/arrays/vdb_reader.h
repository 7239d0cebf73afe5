// OpenVDB files (.vdb): sparse grids of numbers, or of vectors of them. A build may lack this.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

// A grid is drawn on the box of its active voxels, of several files the box that holds all of
// these; voxels that are not active have the value that the file gives them, most often the grid's
// background. Several files are a series of steps. Throws FileError.
std::unique_ptr<Reader> openVdb(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
