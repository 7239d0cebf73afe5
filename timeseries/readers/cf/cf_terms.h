// Variables that say something of another one's points, of some of its dimensions: where they stand
// (CF 1.10, section 5.2), what their heights are made of (4.3.3).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
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

// Which of a term's dimensions are x, y, z and time, where it lies on other columns than the
// variable, beside each of which one of these is: as the rho points of a C-grid lie about its u
// points. Time and levels are the variable's; the other two, in the order of the variable's, are
// its own, or as long, or longer or shorter by one, which at least one is. Above places in a list
// the columns are the variable's, and the levels those between which its own are: one more, called
// as these and "P1" (MPAS). Nothing of any other term. REQUIRES: roles.x, and y of what is no list.
std::optional<Roles> rolesBeside(const NcHeader& header, const NcVariable& term,
                                 const NcVariable& variable, const Roles& roles);

// Of one step, or the last that there is; not a number where the file has none. REQUIRES:
// spansNoMore. Throws FileError, and std::invalid_argument when there is too much of it.
TermValues termOf(const CfFile& file, const NcVariable& term, const NcVariable& variable,
                  const Roles& roles, std::size_t step);

// Of such a term (`own`: its roles) at `size` places along x, y and z: where it has one more along
// an axis, the mean of the two about each place; where it has one fewer, too, and at both ends that
// of the outermost. Where one of them has no value, those of the others. Throws as termOf, and
// std::invalid_argument of other lengths.
TermValues termBeside(const CfFile& file, const NcVariable& term, const Roles& own,
                      const std::array<std::size_t, 3>& size, std::size_t step);

}  // namespace timeseries
