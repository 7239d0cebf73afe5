// The times of an array's steps: from key/value pairs, else from the time axis itself, else
// counted. NRRD has no field for uneven times.
#pragma once

#include <string>
#include <vector>

#include "timeseries/readers/arrays/array_axes.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// Throws FileError.
TimeAxis arrayTimes(const ArrayHeader& header, const ArrayRoles& roles,
                    std::vector<std::string>& notes);

}  // namespace timeseries
