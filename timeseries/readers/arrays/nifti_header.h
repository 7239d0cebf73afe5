// The header of a NIfTI-1 or NIfTI-2 file (.nii, .nii.gz, or .hdr beside .img).
// https://nifti.nimh.nih.gov
#pragma once

#include <string_view>

#include "timeseries/readers/arrays/array_header.h"

namespace timeseries {

// Whether a file that begins so, unpacked, is one.
bool isNifti(std::string_view start);

// Throws FileError. Reads the header only.
ArrayHeader readNiftiHeader(const std::filesystem::path& path);

}  // namespace timeseries
