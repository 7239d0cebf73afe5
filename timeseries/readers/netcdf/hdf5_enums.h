// Datasets of HDF5 whose whole numbers have names, as h5py's truth values have. netCDF's library
// passes over them, or has them as a type of its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/field.h"

namespace timeseries {

struct Hdf5Enum {
    ValueType type{};  // of the numbers
    std::vector<std::uint64_t> lengths;
    std::uint64_t chunkBytes = 0;  // as NcVariable has it
};
using Hdf5Enums = std::map<std::string, Hdf5Enum>;  // "v", in a group "g/v"

// REQUIRE: the lock of HDF5.

// Takes the dataset in if it is one; `dataset` is HDF5's.
void takeHdf5Enum(std::int64_t dataset, const char* name, Hdf5Enums& enums);
// The numbers, whether they have a name or not. False where they cannot be read.
bool readHdf5Enum(const std::filesystem::path& path, const std::string& name, ValueType type,
                  std::span<const std::size_t> start, std::span<const std::size_t> count,
                  void* values);

}  // namespace timeseries
