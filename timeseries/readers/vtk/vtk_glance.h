// What a VTK file tells of its step before it is opened: by its header, without VTK, its cells and
// its values.
#pragma once

#include <filesystem>
#include <optional>

#include "timeseries/readers/sequence_reader.h"

namespace timeseries {

// Nothing of a list of files. A file of which only VTK can tell the time is opened.
std::optional<Glance> vtkGlanceAt(const std::filesystem::path& path);

}  // namespace timeseries
