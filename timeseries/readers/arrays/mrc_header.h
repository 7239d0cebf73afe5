// The header of an MRC or CCP4 map: densities of electron microscopy and crystallography. Cheng and
// others, "MRC2014: Extensions to the MRC format header for electron cryo-microscopy and
// tomography", Journal of Structural Biology 192 (2015). Read here: libccp4 8.0 tells neither the
// order of bytes, nor the origin that MRC2014 added, nor where the values begin.
#pragma once

#include <string_view>

#include "timeseries/readers/arrays/array_header.h"

namespace timeseries {

// Whether a file that begins so is one.
bool isMrc(std::string_view start);

// Throws FileError. Reads the header only.
ArrayHeader readMrcHeader(const std::filesystem::path& path);

}  // namespace timeseries
