// NetCDF files, classic and NetCDF-4, by the CF conventions; and files of its data model in other
// formats.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "timeseries/readers/cf/cf_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// Several files are one series, joined along time. REQUIRES: paths not empty. Throws FileError.
std::unique_ptr<Reader> openNetcdf(std::span<const std::filesystem::path> paths);

// `known`: it was opened before.
using OpenCfFile =
    std::function<std::unique_ptr<CfFile>(const std::filesystem::path& path, bool known)>;
// As openNetcdf. `first` is the first of them.
std::unique_ptr<Reader> openCf(std::span<const std::filesystem::path> paths,
                               std::unique_ptr<CfFile> first, OpenCfFile open);

}  // namespace timeseries
