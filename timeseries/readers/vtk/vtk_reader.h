// VTK files of points on a grid, by VTK's own readers: XML image data (.vti), rectilinear (.vtr)
// and structured grids (.vts), the same in legacy files (.vtk), and collections of them (.pvd).
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

// Several files, or lists of some, are one series: each file is opened when a step of it is read.
// REQUIRES: paths not empty. Throws FileError.
std::unique_ptr<Reader> openVtk(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
