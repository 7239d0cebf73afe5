// What a field has between the cells that have its values: at their corners.
#pragma once

#include <memory>

#include "timeseries/grid/field.h"
#include "timeseries/together.h"

namespace timeseries {

// The field with atNodes, where its mesh has nodes (SolidCells::haveMiddles()); else, or where it
// has them, itself. A node has the mean of its cells' values, each by one over the distance of the
// cell's middle (Shepard, "A two-dimensional interpolation function for irregularly-spaced data",
// 1968, of power 1): of cells about it that mirror each other a linear field's own value; where
// they are alike exactly theirs. Missing and infinite values do not count; a node of no others has
// NaN. On so many threads; not a bit depends on them.
std::shared_ptr<const Field> withNodeValues(std::shared_ptr<const Field> field,
                                            unsigned threads = sharingThreads());

}  // namespace timeseries
