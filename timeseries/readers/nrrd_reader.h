// NRRD files (.nrrd, .nhdr): regular grids of numbers, in one file or with values beside the
// header. http://teem.sourceforge.net/nrrd/format.html
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

// REQUIRES: paths not empty. Throws FileError, also for more than one path.
std::unique_ptr<Reader> openNrrd(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
