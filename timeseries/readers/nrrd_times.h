// The times of an NRRD file's steps: from key/value pairs, else from the time axis itself, else
// counted. The format has no field for uneven times.
#pragma once

#include <string>
#include <vector>

#include "timeseries/readers/nrrd_axes.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// Throws FileError.
TimeAxis nrrdTimes(const NrrdHeader& header, const NrrdRoles& roles,
                   std::vector<std::string>& notes);

}  // namespace timeseries
