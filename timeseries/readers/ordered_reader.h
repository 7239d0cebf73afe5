// Steps in ascending time, of files that have them otherwise.
#pragma once

#include <memory>

#include "timeseries/readers/reader.h"

namespace timeseries {

// The same reader where they are, or are counted. Where they cannot be, for two have the same time,
// or one has none, a note says so.
std::unique_ptr<Reader> inOrderOfTime(std::unique_ptr<Reader> reader);

}  // namespace timeseries
