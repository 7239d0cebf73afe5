// All values of a coordinate variable, unpacked, and the units of angles.
#pragma once

#include <string>
#include <vector>

#include "timeseries/readers/cf/cf_file.h"

namespace timeseries {

// In the file's order, whole ones exactly; not a number where the file has none. REQUIRES: a
// numeric type. Throws FileError.
std::vector<Number> numbersOf(const CfFile& file, const NcVariable& coordinate);
std::vector<double> valuesOf(const CfFile& file, const NcVariable& coordinate);

// A whole turn in degrees or radians; 0 of what comes round to itself in another measure, or not at
// all.
double turnIn(const std::string& units);
// How many degrees one of radians is; 1 of all else.
double degreesIn(const std::string& units);

}  // namespace timeseries
