// Columns of points above the places of a mesh, each at heights of its own: what a formula or the
// file gives of each.
#pragma once

#include <span>

#include "timeseries/grid/mesh.h"

namespace timeseries {

// `prisms`: columns of the same places, of several levels. `heights`: [level][place], not a number
// where there is no point. Each point stands for what its prism has below it, halfway to those
// above and below it; the first and the last of a column as far beyond. Between columns is what is
// between those of `prisms`. REQUIRES: a whole number of levels. Throws std::invalid_argument as
// Mesh does.
Mesh raised(const Mesh& prisms, std::span<const double> heights);

}  // namespace timeseries
