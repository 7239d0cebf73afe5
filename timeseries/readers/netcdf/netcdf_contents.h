// What one file of netCDF's data model offers to be drawn, by the CF conventions.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/cf/cf_file.h"
#include "timeseries/readers/cf/cf_grid.h"
#include "timeseries/readers/cf/cf_packing.h"
#include "timeseries/readers/cf/cf_time.h"

namespace timeseries {

struct FileVariable {
    std::string name, longName, units;
    std::string stored;  // what the file calls it, and others of its members (cf_members.h), too
    std::vector<std::uint64_t> lengths;  // of its dimensions, slowest first
    ValueType type{};                    // in the file
    bool categories = false;             // as Field::categories
    std::vector<ClassName> classes;
    Roles roles;
    std::vector<std::pair<std::size_t, std::uint64_t>> at;  // as Member has it
    Packing packing;
    VariableAxes axes;
    StoredTimes times;
    std::vector<std::string> notes;
};

struct FileContents {
    std::vector<FileVariable> variables;  // in the file's order, members last; not empty
    // For malformed attributes, of coordinates too, or for dimensions that are no axes.
    std::vector<DamagedVariable> damaged;
};

// Throws FileError when no variable is left: of one that is damaged, else with those that were
// passed over and why.
FileContents contentsOf(const CfFile& file);

}  // namespace timeseries
