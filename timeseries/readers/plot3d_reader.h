// PLOT3D files of a structured grid: the flow (Q), at the places (XYZ) that a file beside it has.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "timeseries/readers/reader.h"

namespace timeseries {

bool isPlot3d(std::string_view start, std::uint64_t bytes);
// The places that other files have the values of.
bool isPlot3dPlaces(const std::filesystem::path& path);
// The first of the paths. Throws FileError.
std::unique_ptr<Reader> openPlot3d(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
