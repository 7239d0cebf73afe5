// Chunks of NetCDF-4 files, which HDF5 unpacks whole.
#pragma once

#include <cstddef>
#include <span>

#include "timeseries/readers/cf/netcdf_header.h"

namespace timeseries {

// Where the chunks of a block hold values of others, of further steps mostly, HDF5 keeps them all
// unpacked for as long as they fit kMaxKeptChunks: else each step unpacks them anew. REQUIRES: the
// library's lock; an open file's variable.
void keepChunks(const NcVariable& variable, std::span<const std::size_t> start,
                std::span<const std::size_t> count);

}  // namespace timeseries
