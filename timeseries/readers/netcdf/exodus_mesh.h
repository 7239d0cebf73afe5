// The mesh of an Exodus II file: a netCDF file whose arrays list nodes and blocks of elements
// (Schoof and Yarberry, "EXODUS II: A Finite Element Data Model", SAND92-2137, and the names that
// its library writes).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/netcdf/netcdf_file.h"

namespace timeseries {

bool isExodus(const NcHeader& header);

struct ExodusMesh {
    UnstructuredGrid grid;
    std::vector<std::uint64_t>
        blocks;  // how many elements each has; they stand one behind the other
    std::vector<std::string> notes;
};
// Throws FileError.
ExodusMesh exodusMeshOf(const NetcdfFile& file);

// Shared with what reads the values. The length of a dimension; 0 when there is none.
std::uint64_t exodusLength(const NcHeader& header, std::string_view dimension);
// The variable of that name, of numbers, whose dimensions have these lengths; null when there is
// none of the name. Throws FileError when it is another, or the file cannot hold it.
const NcVariable* exodusVariable(const NetcdfFile& file, const std::string& name,
                                 const std::vector<std::uint64_t>& lengths);

}  // namespace timeseries
