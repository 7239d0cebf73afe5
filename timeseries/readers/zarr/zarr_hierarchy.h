// The groups and arrays of a Zarr hierarchy of version 2 or 3, in a folder or a zip file: what its
// folders hold, whatever .zmetadata or consolidated_metadata say of them, which are copies.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "timeseries/readers/reader.h"
#include "timeseries/readers/zarr/zarr_array.h"
#include "timeseries/readers/zarr/zarr_store.h"

namespace timeseries {

struct ZarrGroup {
    std::string name;  // "" for the hierarchy itself, else "a/b"
    ZarrJson attributes;
};

struct ZarrHierarchy {
    std::shared_ptr<const ZarrStore> store;
    std::string format;             // "Zarr v2"
    std::vector<ZarrGroup> groups;  // one comes before what lies in it; names in natural order
    std::vector<ZarrArray> arrays;  // alike
    std::vector<DamagedVariable> damaged;  // whose metadata are none
    std::string only;                      // the array that was named, "" for all
};

// Whether it is such a folder, of a group or an array, or a file of metadata in one, or a zip file.
bool isZarr(const std::filesystem::path& path);

// Of an array's folder: with what else is in its group, which may place its values. REQUIRES:
// isZarr(). Throws FileError.
ZarrHierarchy zarrHierarchyOf(const std::filesystem::path& path);

}  // namespace timeseries
