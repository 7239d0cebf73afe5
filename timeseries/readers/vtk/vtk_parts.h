// What VTK files hold beside values: one file, or one whose parts are files of their own (.pvti,
// .pvtr, .pvts, .pvtu, .pvtp, .vtm, .vthb), put together.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "timeseries/readers/vtk/vtk_library.h"

namespace timeseries {

struct VtkContents {
    VtkHeader whole;
    std::vector<VtkHeader> parts;  // none: all is in the file itself
    // By part and VtkPlace, where blocks lie over each other: points that are missing, and cells
    // that are none of the whole. Empty where there are none.
    std::vector<std::array<std::vector<bool>, 2>> covered;
};

// With the coordinates of a rectilinear grid, the places of a structured one and the cells of an
// unstructured one. Throws FileError.
VtkContents vtkContentsOf(const std::filesystem::path& path);
VtkContents vtkContentsOf(const XmlFile& file);
VtkContents vtkContentsOf(const VtkMember& member);

// "ImageData" of "PImageData": of what kind the files are that hold the parts of one grid; "" of
// another type of file.
std::string_view vtkTypeOfParts(std::string_view type);
// Drops those that such a file does not declare, where it declares any: VTK knows no others.
void keepDeclared(const XmlFile& file, std::vector<VtkArray>& arrays);
// use() of each of those files, while it returns true. REQUIRES: the file is of such a type. Throws
// FileError.
void forEachVtkPart(const XmlFile& file, const std::function<bool(const XmlFile& part)>& use);

// As readVtkArray of a header; `array` is the whole's. Of points that several parts have, the one
// that is no ghost counts. Missing are those of a block without it.
void readVtkArray(const VtkContents& contents, const VtkArray& array, VtkPart part,
                  const StridedLayout& layout, Field& field);

}  // namespace timeseries
