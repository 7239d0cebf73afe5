// What the field `data file` of an NRRD header names: one file, a LIST, or a numbered pattern.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "timeseries/readers/arrays/array_header.h"

namespace timeseries {

struct NrrdDataFile {
    std::optional<std::string> field;  // nothing when the values are behind the header
    std::vector<std::string> list;     // the lines after `data file: LIST`
};

// REQUIRES: the field is there, and the header's axes are known. Throws FileError.
std::vector<std::string> namesOf(const ArrayHeader& header, const NrrdDataFile& dataFile);

}  // namespace timeseries
