// Formats whose files are netCDF's or HDF5's, with meanings of their own: told by what they hold.
#pragma once

#include <memory>
#include <string_view>

#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

struct OtherNetcdf {
    std::string_view what;  // "an Exodus II mesh"
    bool (*holds)(const NcHeader& header);
    std::unique_ptr<Reader> (*open)(std::unique_ptr<NetcdfFile> file);
};

// Null where the header is of none of them.
const OtherNetcdf* otherNetcdf(const NcHeader& header);

}  // namespace timeseries
