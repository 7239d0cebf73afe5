// The grid of a variable from its coordinate variables; where these cannot place the points, they
// are counted instead, and a note says so.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/grid.h"
#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/cf/cf_columns.h"
#include "timeseries/readers/cf/cf_earth.h"
#include "timeseries/readers/cf/cf_file.h"

namespace timeseries {

// x, y, z; an axis the variable does not have is one point at index 0. Where columns tell where
// points lie, x and y are only counted, and called as their coordinates are.
struct VariableAxes {
    std::array<Axis, 3> axes;
    std::optional<ColumnPlaces> columns = {};
    // Beside axes that are drawn as they are.
    std::optional<EarthTold> earth = {};
};

// `geographic`: the file's longitudes and latitudes of any rank. `list`: where the points lie, of a
// variable on a mesh. Throws FileError when coordinates cannot be read.
VariableAxes axesOf(const CfFile& file, const FileAxes& fileAxes, const NcVariable& variable,
                    const Roles& roles, std::span<const NcVariable* const> geographic,
                    const std::optional<ColumnPlaces>& list, std::vector<std::string>& notes);

}  // namespace timeseries
