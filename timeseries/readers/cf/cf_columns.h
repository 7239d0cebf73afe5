// Longitudes and latitudes of two dimensions (CF 1.10, section 5.2): where each column of points
// stands. They may change in time, as those of a nest that moves, and so may the columns' heights.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "timeseries/grid/grid.h"
#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/cf/cf_file.h"
#include "timeseries/readers/cf/cf_heights.h"

namespace timeseries {

// The variables that tell, by their names.
struct ColumnPlaces {
    std::string x, y;
    bool inTime = false;
    // What lies about each place: its neighbours along both dimensions; or of places in a list
    // (cf_lists.h) the polygon of its bounds, its face of a mesh, or the faces about it as a node
    // or an edge.
    enum class By { Neighbours, Bounds, Faces, Nodes, Edges } by = By::Neighbours;
    std::string faces = {};  // the mesh's connectivity
    bool turned = false;     // of which the faces are the second dimension
    std::string edges = {};  // alike
    bool edgesTurned = false;
    // How many nodes each face has; "": all that there are. What the first one counts as, where the
    // connectivity does not say. The units of a longitude x and a latitude y that do not say what
    // they are; "": they do.
    std::string faceSizes = {};
    int firstNode = 0;
    std::string units = {};
    // What the coordinates of the places themselves are called, where x and y are of what stands
    // about them; "": as these are.
    std::string xName = {}, yName = {};
    // Each column has heights of its own. `upright`: x and y are coordinates of one dimension.
    std::optional<HeightFormula> heights = {};
    bool upright = false;
    friend bool operator==(const ColumnPlaces&, const ColumnPlaces&) = default;
};

// Those of `geographic` that span both horizontal dimensions of the variable: a longitude and a
// latitude that its attribute `coordinates` names, or the only ones. `told` are the declarations
// of all that span them, "nav_lon(y, x) and nav_lat(y, x)"; "" when there are none. REQUIRES:
// roles.x and roles.y.
struct FoundColumns {
    std::optional<ColumnPlaces> places;
    std::string told;
};
FoundColumns columnsOf(const NcHeader& header, const NcVariable& variable, const Roles& roles,
                       std::span<const NcVariable* const> geographic);

// Of that step of the file, with the levels of `z` above each column, or its own heights. Throws
// FileError, and std::invalid_argument when the places make no mesh.
std::shared_ptr<const Mesh> meshOf(const CfFile& file, const NcVariable& variable,
                                   const Roles& roles, const ColumnPlaces& columns, const Axis& z,
                                   std::size_t step);

}  // namespace timeseries
