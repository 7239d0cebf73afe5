// One VTK file by itself: its header, and of what is beside the values all.
#pragma once

#include <filesystem>

#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

bool isVtkLegacy(const std::filesystem::path& path);
// JSON, not XML.
bool isVtkSeries(const std::filesystem::path& path);

// With the coordinates of a rectilinear grid, the places of a structured one and the cells of an
// unstructured one. Throws FileError.
VtkHeader openVtkLegacy(const std::filesystem::path& path);
VtkHeader openVtkXml(const XmlFile& file);

// What writers leave of a part, or of a block, in which nothing of the grid is.
bool isEmptyVtkFile(const XmlFile& file);

}  // namespace timeseries
