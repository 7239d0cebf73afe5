// What a file of HDF5 has of other files: by external links, virtual datasets or external storage
// ("HDF5 File Format Specification 3.0", IV.A.2.g, h and i). Those may change while it does not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace timeseries {

struct Hdf5Elsewhere {
    bool any = false;  // also where that cannot be told
    double bytes = 0;  // of the files that virtual datasets and external storage lie in
    // Of virtual datasets ("v", in a group "g/v") that have values of a dataset which is not
    // there: its file, and its name. HDF5 reads a fill value instead, and says nothing.
    std::map<std::string, std::string> missing;
};

// Nothing of a file of another format. `also` looks at each dataset, which is HDF5's, under each of
// its names. REQUIRES: the lock of HDF5.
using LookAtHdf5 = std::function<void(std::int64_t dataset, const char* name)>;
Hdf5Elsewhere hdf5Elsewhere(const std::filesystem::path& path, const LookAtHdf5& also);

// A link to something that is not there, "'a', which leads to '/b'", for which netCDF's library
// reads nothing of the file; "" where there is none. REQUIRES: as above.
std::string deadHdf5Link(const std::filesystem::path& path);

}  // namespace timeseries
