// Which dimension of a variable is longitude, latitude, height, time: by the attributes of its
// coordinate variable, then by names, then by position (CF 1.10, chapters 4 and 5).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "timeseries/readers/netcdf_header.h"

namespace timeseries {

enum class AxisKind { X, Y, Z, T, Other };

// What the variable's own attributes or name tell of the axis it is a coordinate of; nothing when
// they tell nothing.
std::optional<AxisKind> kindByAttributes(const NcVariable& coordinate);
std::optional<AxisKind> kindByName(std::string_view name);

// The coordinate variable of a dimension: one-dimensional, numeric, of its name, else named by the
// attribute `coordinates`. Null if none.
const NcVariable* coordinateOf(const NcHeader& header, const NcVariable& variable,
                               std::size_t position);

// Positions in NcVariable::dimensions.
struct Roles {
    std::optional<std::size_t> x, y, z, t;
    std::vector<std::size_t> extra;  // longer than 1 and none of these
    int spatial() const { return int{x.has_value()} + int{y.has_value()} + int{z.has_value()}; }
};
Roles rolesOf(const NcHeader& header, const NcVariable& variable);

}  // namespace timeseries
