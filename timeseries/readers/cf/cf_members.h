// Variables with a dimension that is no axis: of an ensemble, of wavelengths, species or
// components, each place along it is a field of its own.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/cf/cf_file.h"

namespace timeseries {

struct Member {
    // Of each dimension that is no axis its position in the variable, and the place along it.
    std::vector<std::pair<std::size_t, std::uint64_t>> at;
    // What tells it from the others, in a name ("wavelength=550") and in words ("wavelength 550
    // nm"): by the dimension's coordinate, or counted from 0. Both "" of a variable without such.
    std::string key, told;
};

constexpr std::uint64_t kMostMembers = 256;

// The last dimension the fastest. REQUIRES: at most so many. Throws FileError.
std::vector<Member> membersOf(const CfFile& file, const FileAxes& fileAxes,
                              const NcVariable& variable, const Roles& roles);

}  // namespace timeseries
