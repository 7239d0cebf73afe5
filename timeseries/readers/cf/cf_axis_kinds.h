// Which axis a coordinate variable is of, by the words of its attributes and by names (CF 1.10,
// chapters 4 and 5).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "timeseries/readers/cf/netcdf_header.h"

namespace timeseries {

enum class AxisKind { X, Y, Z, T, List, Other };

// What the variable's own attributes or name tell of the axis it is a coordinate of; nothing when
// they tell nothing.
std::optional<AxisKind> kindByAttributes(const NcVariable& coordinate);
std::optional<AxisKind> kindByName(std::string_view name);
// Degrees along the equator, by its units (CF 1.10, section 4.2) or its standard name.
bool isLongitude(const NcVariable& coordinate);
bool isLatitude(const NcVariable& coordinate);  // likewise, from the equator
// Without the modifiers that may follow it.
std::string standardName(const NcVariable& coordinate);
// Since when, and for when, is foretold: times where a variable has no other, members beside one.
bool isOfForecast(const NcVariable& coordinate);

}  // namespace timeseries
