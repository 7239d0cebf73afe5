// Output of FESOM 2: values at the nodes (dimension nod2) or in the triangles (elem) of a mesh that
// stands in a second file beside them, RUN.mesh.diag.nc (FESOM 2, io_meshinfo and io_meandata).
#pragma once

#include <memory>

#include "timeseries/readers/netcdf/netcdf_file.h"

namespace timeseries {

// Values and mesh as one file, which says by UGRID 1.0 how they belong together; what is none of
// FESOM's as it is. Values below the sea floor, or above the ceiling of a cavity, are missing, as
// far as the mesh says where these are. Throws FileError, which names the files that were looked
// for when there is no mesh. `header`: of the mesh, which was read with the values before, or was
// not.
std::unique_ptr<CfFile> withFesomMesh(std::unique_ptr<NetcdfFile> file, NetcdfFile::Header header);

}  // namespace timeseries
