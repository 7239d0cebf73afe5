// What needs OpenVDB itself: a library of its own, libisochron_vdb.so, which is loaded where a file
// of that format is opened. To link OpenVDB would be half of the program's start.
#pragma once

#include <filesystem>
#include <vector>

#include "timeseries/readers/arrays/vdb_grid.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

struct VdbContents {
    std::vector<VdbGrid> grids;
    std::vector<DamagedVariable> damaged;
};

// Both throw FileError, and std::bad_alloc; where a damaged file makes OpenVDB crash, they do.
struct VdbLibrary {
    VdbContents (*contents)(const std::filesystem::path& path);
    // Of a box that holds the grid's, x fastest, the numbers of a voxel one behind the other.
    // REQUIRES: it has a count().
    Values (*read)(const std::filesystem::path& path, const VdbGrid& grid, const VdbBox& box);
};

}  // namespace timeseries

// In the library.
extern "C" const timeseries::VdbLibrary isochronVdb;
