// The variables that the arrays of a VTK file are.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "timeseries/readers/vtk/vtk_library.h"

namespace timeseries {

// An array of one component; of one of several each component, and of up to three the magnitude.
struct VtkVariable {
    std::string name;
    ValueType type{};
    std::string storedAs;
    VtkArray array;
    VtkPart part;
};
// In the order of the arrays, of one file. Throws FileError when they are too many.
std::vector<VtkVariable> vtkVariablesOf(const std::filesystem::path& path,
                                        std::span<const VtkArray> arrays);

}  // namespace timeseries
