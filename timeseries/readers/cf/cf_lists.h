// Places one after another, as unstructured meshes list them, and the polygon about each: by its
// bounds (CF 1.10, section 7.1), or by the faces of a mesh (UGRID 1.0).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "timeseries/grid/mesh.h"
#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/cf/cf_columns.h"
#include "timeseries/readers/cf/cf_file.h"

namespace timeseries {

// By what writers of meshes say: UGRID 1.0, section "data defined on unstructured grids"; CDI
// (ICON); MPAS (cf_mpas.h).
bool saysMesh(const NcHeader& header, const NcVariable& variable);

// A variable that lies on one: x is the list's dimension, z of the levels above each place.
struct FoundList {
    ColumnPlaces places;
    Roles roles;
};
// Nothing when the file does not tell what is about its places. `geographic`: the file's longitudes
// and latitudes.
std::optional<FoundList> listOf(const NcHeader& header, const NcVariable& variable,
                                const Roles& roles, std::span<const NcVariable* const> geographic);

// With columns above the places, if there are levels. Throws FileError, and std::invalid_argument
// when no place has a polygon of any area.
std::shared_ptr<const Mesh> meshOfList(const CfFile& file, const ColumnPlaces& places,
                                       const std::vector<double>& levels);

}  // namespace timeseries
