// The attributes of a Zarr array, in netCDF's data model.
#pragma once

#include <vector>

#include "timeseries/readers/cf/netcdf_header.h"
#include "timeseries/readers/zarr/zarr_array.h"

namespace timeseries {

// Texts, numbers and lists of them; what else there may be tells nothing here. The fill of an array
// of version 2 that xarray wrote is _FillValue, which xarray puts nowhere else.
std::vector<NcAttribute> zarrAttributesOf(const ZarrArray& array);

}  // namespace timeseries
