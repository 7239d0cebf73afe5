// A mesh of faces as UGRID 1.0 declares it: what each file of one has before its values.
#pragma once

#include <string>

#include "tests/support/netcdf_builder.h"

namespace tests {

// Variables x and y of the nodes, and `nodes` of the faces; the mesh is called "mesh".
struct UgridVariables {
    int x, y, nodes;
};
inline UgridVariables declareUgrid(NetcdfBuilder& file, int nodes, int faces, int corners,
                                   const std::string& unitsOfX, const std::string& unitsOfY) {
    const int mesh = file.variable("mesh", NC_INT, {});
    file.text(mesh, "cf_role", "mesh_topology");
    file.text(mesh, "node_coordinates", "x y");
    file.text(mesh, "face_node_connectivity", "nodes");
    const UgridVariables declared{file.variable("x", NC_DOUBLE, {nodes}),
                                  file.variable("y", NC_DOUBLE, {nodes}),
                                  file.variable("nodes", NC_INT, {faces, corners})};
    file.text(declared.x, "units", unitsOfX);
    file.text(declared.y, "units", unitsOfY);
    return declared;
}

}  // namespace tests
