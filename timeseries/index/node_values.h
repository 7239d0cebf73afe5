// What a field has between the cells that have its values: at their corners.
#pragma once

#include <memory>

#include "timeseries/grid/field.h"
#include "timeseries/together.h"

namespace timeseries {

// The field with atNodes, where its mesh has nodes (SolidCells::haveMiddles()); else, or where it
// has them, itself. A node has the mean of its cells' values, each by one over the distance of the
// cell's middle, times what makes the mean of a linear field that field's own value there (Holmes,
// Connell, "Solution of the 2D Navier-Stokes equations on unstructured adaptive grids", AIAA
// 89-1932, 1989), 0 to 2; where all middles lie to one side, without that. Never beyond its cells'
// values, and where these are alike exactly theirs. Missing and infinite values do not count; a
// node of no others has NaN. On so many threads; not a bit depends on them.
std::shared_ptr<const Field> withNodeValues(std::shared_ptr<const Field> field,
                                            unsigned threads = sharingThreads());

}  // namespace timeseries
