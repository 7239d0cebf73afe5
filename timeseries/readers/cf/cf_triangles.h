// Triangles between the places of an unstructured mesh, above which columns of points have prisms
// between them. By the mesh's connections alone, so that they are the same wherever places lie.
#pragma once

#include <cstddef>
#include <vector>

#include "timeseries/grid/solid_cells.h"
#include "timeseries/readers/cf/cf_polygons.h"

namespace timeseries {

// Between nodes: each face parted from the least of its own.
std::vector<SolidCells::Foot> trianglesOfNodes(const NodesOf& faces);
// Between faces: about each of so many nodes the ring of those that have it, each beside the next
// at an edge; at the mesh's end from the last of them to the first, if there are three: by a
// straight line, which at a corner of the mesh may lie up to half a face beyond it.
std::vector<SolidCells::Foot> trianglesOfFaces(const NodesOf& faces, std::size_t nodes);

// The nodes of polygons that have as many corners each, which are told by where they lie: corners
// at one place are one node, whole turns apart or not, and so are those at a pole. Returns how many
// nodes there are.
std::size_t nodesAtCorners(const PlaneCoordinates& corners, std::size_t each, NodesOf& polygons);

}  // namespace timeseries
