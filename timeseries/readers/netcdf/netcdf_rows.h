// Rows of numbers that stand in an array one behind the other: values at points that are listed,
// and the places of these.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "timeseries/readers/netcdf/netcdf_file.h"

namespace timeseries {

// So many rows of a variable from this one on, as stored, each of so many numbers. Throws FileError
// when the file has fewer, or others.
Values rowsOf(const NetcdfFile& file, const NcVariable& variable, std::uint64_t first,
              std::uint64_t rows, std::uint64_t columns);

std::vector<double> asDoubles(const Values& values);

// Of rows of three numbers.
std::vector<glm::dvec3> placesOf(const Values& rows);
// Throws FileError.
std::vector<glm::dvec3> placesOf(const NetcdfFile& file, const NcVariable& variable,
                                 std::uint64_t first, std::uint64_t rows);

}  // namespace timeseries
