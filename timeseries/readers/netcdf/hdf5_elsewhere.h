// Whether a file of HDF5 has values of other files: by external links, virtual datasets or external
// storage ("HDF5 File Format Specification 3.0", IV.A.2.g, h and i). Those may change while it does
// not.
#pragma once

#include <filesystem>

namespace timeseries {

// Also where that cannot be told. False of a file of another format. REQUIRES: the lock of HDF5.
bool hdf5HasValuesElsewhere(const std::filesystem::path& path);

}  // namespace timeseries
