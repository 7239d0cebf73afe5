// One array of numbers on a regular grid, in one file or with values beside their header, of which
// an ArrayHeader tells all: NRRD, NIfTI, MRC.
#pragma once

#include <memory>

#include "timeseries/readers/arrays/array_header.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// Throws FileError.
std::unique_ptr<Reader> openArray(ArrayHeader header);

}  // namespace timeseries
