// AMReX's plotfiles, as AMReX, Castro, Nyx, PeleLM, MAESTROeX and WarpX write them: the leaves of
// adaptive meshes, each variable a scalar field at the middles of cells.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

// Several are one series. REQUIRES: isAmrex() of each (amrex_header.h); paths not empty. Throws
// FileError.
std::unique_ptr<Reader> openAmrex(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
