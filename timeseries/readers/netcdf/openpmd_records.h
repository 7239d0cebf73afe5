// What an openPMD file holds of each iteration: the records of its meshes and of its particles
// (openPMD standard 1.1.0, https://www.openPMD.org). HDF5 is read through netCDF.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/readers/netcdf/netcdf_file.h"

namespace timeseries {

bool isOpenPmd(const NcHeader& header);

// One number a point: an array of the file, or a group that says one for all of them ("Constant
// Record Components").
struct OpenPmdComponent {
    std::string name;                      // "B/x"; the record's own of a scalar one, "rho"
    std::string place;                     // "iteration 100: record component 'B/x'"
    const NcVariable* array = nullptr;     // null: it is constant
    const NcAttributes* own = nullptr;     // what it says of itself
    const NcAttributes* record = nullptr;  // and its record: the same of a scalar one
};

struct OpenPmdIteration {
    std::uint64_t number = 0;
    std::optional<double> seconds;
    std::vector<OpenPmdComponent> meshes;  // in the file's order, those that are constant last
    std::map<std::string, std::vector<OpenPmdComponent>> species;  // the same of each
};

// Ascending, of those with records at least one. They point into the file's header. Throws
// FileError, also of other versions of the standard than 1.
std::vector<OpenPmdIteration> openPmdIterationsOf(const NetcdfFile& file);

// What a component is made of.
struct OpenPmdNumbers {
    ValueType type{};
    std::vector<std::uint64_t> lengths;  // of its dimensions, as stored: the slowest first
    std::uint64_t count = 0;             // in all; of a scalar 0, for it lies nowhere
};
// Throws AttributeError where they are no numbers, or more than the file can hold.
OpenPmdNumbers openPmdNumbersOf(const NetcdfFile& file, const OpenPmdComponent& component);
// An attribute, of the component or its record, that is one number; `otherwise` where there is
// none. Throws AttributeError where it is not finite, or something else.
double openPmdNumber(const NetcdfFile& file, const OpenPmdComponent& component,
                     const NcAttributes& attributes, const char* name, double otherwise);
// What its values count, for which unitSI and unitDimension stand: "0.001 kg s-2 A-1".
// Throws AttributeError.
std::string openPmdUnitsOf(const NetcdfFile& file, const OpenPmdComponent& component);

// All of a constant component's. REQUIRES: it is one, and has these numbers.
Values openPmdConstant(const OpenPmdComponent& component, const OpenPmdNumbers& numbers);

// As an AttributeError.
[[noreturn]] void failComponent(const NetcdfFile& file, const OpenPmdComponent& component,
                                const std::string& what);

}  // namespace timeseries
