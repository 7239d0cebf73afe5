// The header of an NRRD file. teem reads the fields; the line that names data files is read here
// (nrrd_files), for teem hands its pattern to printf.
// http://teem.sourceforge.net/nrrd/format.html
#pragma once

#include "timeseries/readers/arrays/array_header.h"

namespace timeseries {

// Throws FileError. Reads the header only.
ArrayHeader readNrrdHeader(const std::filesystem::path& path);

}  // namespace timeseries
