// A field's file of an OpenFOAM case: what it is of, and its values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "timeseries/grid/field.h"

namespace timeseries {

struct FoamFieldHead {
    std::string className;         // "volScalarField"
    std::uint64_t components = 0;  // of a value; 0 where values are neither of cells nor of points
    bool atPoints = false;
    ValueType type{};   // what OpenFOAM has in memory: of texts that do not say it, float64
    std::string units;  // "m/s"
};

// Throws FileError.
FoamFieldHead foamFieldHeadOf(const std::filesystem::path& path);

// Appends the values inside, so many, each of the head's components, one behind the other.
// REQUIRES: a type float32 or float64; `out` holds that. Throws FileError, also where the file has
// another class, or a wider type.
void appendFoamValues(const std::filesystem::path& path, const FoamFieldHead& head,
                      std::uint64_t count, Values& out);

// Of dimensions as the file has them between brackets: exponents of kg, m, s, K, mol, A and cd, or
// units themselves. "" where there are none.
std::string foamUnitsOf(const std::vector<std::string>& dimensions);

}  // namespace timeseries
