// The part of a file that is a step of a variable, or a slab of one.
#pragma once

#include <cstddef>
#include <vector>

#include "timeseries/readers/netcdf/netcdf_contents.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/strided_layout.h"

namespace timeseries {

// Along each dimension of the variable, and where each axis runs in it.
struct NetcdfBlock {
    std::vector<std::size_t> start, count;
    StridedLayout layout{{1, 1, 1}, {0, 0, 0}};
};
// `slab`: null for all of the step, which is the file's own.
NetcdfBlock blockOf(const FileVariable& variable, std::size_t step, const Slab* slab);

}  // namespace timeseries
