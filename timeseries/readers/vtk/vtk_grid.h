// The grid that a VTK header means, and where the points of that grid lie among the file's tuples.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "timeseries/grid/grid.h"
#include "timeseries/readers/vtk/vtk_library.h"

namespace timeseries {

struct VtkGrid {
    std::shared_ptr<const Grid> grid;
    StridedLayout layout;
    std::vector<std::string> notes;
};

// Of cell data, the grid of the cells' centres. A rotated or sheared image keeps the order of its
// axes; their coordinates are the file's before it is turned. REQUIRES: coordinates as many as
// points when the header is that of a rectilinear grid, places when of a structured one.
VtkGrid vtkGridOf(const VtkHeader& header, VtkPlace place);
// The grid of unstructured cells. Throw FileError when its cells name points that are not there,
// or take no space.
UnstructuredShapes vtkShapesOf(const VtkHeader& header);
VtkGrid vtkGridOf(const VtkHeader& header, VtkPlace place, const UnstructuredShapes& shapes);

}  // namespace timeseries
