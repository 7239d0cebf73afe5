// Sorted steps that stand alone, as a simulation writes them: one variable at one time in a file
// (timeseries/index/FORMAT.md).
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "timeseries/readers/reader.h"

namespace timeseries {

// What such a file holds. Throws FileError, and StepFileError.
Variable variableOf(const StepFile& file);

// One file. Throws FileError.
std::unique_ptr<Reader> openStep(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
