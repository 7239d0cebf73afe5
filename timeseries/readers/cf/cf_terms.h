// Variables that say something of another one's points, of some of its dimensions: where they stand
// (CF 1.10, section 5.2), what their heights are made of (4.3.3).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/cf/cf_file.h"

namespace timeseries {

// Whether it is numbers, of no other dimensions than the variable's x, y, z and time, or such as
// are as long as 1.
bool spansNoMore(const NcHeader& header, const NcVariable& term, const NcVariable& variable,
                 const Roles& roles);
bool hasTime(const NcVariable& term, const NcVariable& variable, const Roles& roles);

// By the places along x, y and z, of which some make no difference.
struct TermValues {
    std::vector<double> values;
    std::array<std::size_t, 3> stride{};
    double at(std::size_t i, std::size_t j, std::size_t k) const {
        return values[i * stride[0] + j * stride[1] + k * stride[2]];
    }
};

// Of one step, or the last that there is; not a number where the file has none. REQUIRES:
// spansNoMore. Throws FileError, and std::invalid_argument when there is too much of it.
TermValues termOf(const CfFile& file, const NcVariable& term, const NcVariable& variable,
                  const Roles& roles, std::size_t step);

}  // namespace timeseries
