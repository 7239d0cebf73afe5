// Snapshots of particles as Gadget and SWIFT write them (.hdf5): scattered, gas with its volumes
// and smoothing lengths.
#pragma once

#include <memory>

#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// REQUIRES: isSnapshot. Throws FileError.
std::unique_ptr<Reader> openSnapshot(std::unique_ptr<NetcdfFile> file);

}  // namespace timeseries
