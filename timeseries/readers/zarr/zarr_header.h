// A Zarr hierarchy in netCDF's data model: its arrays as variables, with the dimensions that xarray
// (_ARRAY_DIMENSIONS; dimension_names in version 3) and OME-NGFF name, and the coordinates that
// OME-NGFF gives in numbers. Of an array whose dimensions have no names the last three are z, y, x,
// and one before these is time.
#pragma once

#include <optional>
#include <vector>

#include "timeseries/readers/cf/netcdf_header.h"
#include "timeseries/readers/zarr/zarr_hierarchy.h"
#include "timeseries/readers/zarr/zarr_multiscales.h"

namespace timeseries {

// Where a variable's values are.
struct ZarrSource {
    const ZarrArray* array = nullptr;  // null: `places`
    // Of an array of several channels one is a variable: which dimension, and where along it.
    std::optional<std::size_t> channels = {};
    std::size_t channel = 0;
    ZarrPlaces places = {};
};

struct ZarrHeader {
    NcHeader header;                  // NcVariable::id is the source
    std::vector<ZarrSource> sources;  // which point into the hierarchy
    std::vector<DamagedVariable> damaged;
};

ZarrHeader zarrHeaderOf(const ZarrHierarchy& hierarchy);

}  // namespace timeseries
