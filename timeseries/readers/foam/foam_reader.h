// OpenFOAM cases: fields of cells and of points, on meshes of polyhedra that may move and change,
// also of cases that are decomposed.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

// One case. REQUIRES: isFoamCase(). Throws FileError.
std::unique_ptr<Reader> openFoam(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
