// Polygons in the plane of longitude and latitude, or of other coordinates, that stand for what an
// unstructured mesh lists: its places' own corners, its faces, nodes or edges. Each polygon is
// whole, also where longitudes begin anew.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "timeseries/grid/unstructured.h"

namespace timeseries {

// Longitudes and latitudes in degrees, or coordinates in whatever they are measured.
struct PlaneCoordinates {
    std::vector<double> x, y;
    double turn = 0;  // after which x comes round to itself; 0: never
};

// Whether a latitude is that of a pole, where every longitude is the same place.
inline bool isPole(double y, double turn) {
    constexpr double kPole = 90 - 1e-6;
    return turn > 0 && std::abs(y) > kPole;
}

// Of each face or edge the nodes that it has.
using NodesOf = std::vector<std::vector<std::uint32_t>>;

// One a place, as many as cells.
struct PlacedPolygons {
    UnstructuredGrid grid;
    std::vector<glm::dvec3> places;
};

// As many corners for each centre, one behind the other; those that are no numbers are none.
PlacedPolygons polygonsAbout(const PlaneCoordinates& centres, const PlaneCoordinates& corners);

UnstructuredGrid polygonsOfFaces(const PlaneCoordinates& nodes, const NodesOf& faces);

// The nodes, and the faces about them. One that lies where longitudes begin anew is there once for
// either side, with corners on the other side that are no nodes.
UnstructuredGrid polygonsAboutNodes(const PlaneCoordinates& nodes, const NodesOf& faces);

// Each edge has the triangles from it to the middles of the one or two faces that it is a side of,
// so that edges together take what faces take; its place is its own middle. An edge of no face has
// no area.
PlacedPolygons polygonsAboutEdges(const PlaneCoordinates& nodes, const NodesOf& faces,
                                  const NodesOf& edges);

}  // namespace timeseries
