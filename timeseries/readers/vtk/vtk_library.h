// All calls of VTK are made here, under one lock: where its errors go is one setting for the
// whole program.
#pragma once

#include <array>
#include <optional>

#include "timeseries/readers/strided_layout.h"
#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

// What is in the file beside the arrays: VTK decodes it.
struct VtkFrame {
    std::array<std::vector<double>, 3> coordinates;  // of rectilinear grids
    std::vector<glm::dvec3> places;                  // of structured grids
    UnstructuredGrid unstructured;
    std::optional<VtkTime> time;
};
// REQUIRES: an XML header, or one of a structured grid. Throws FileError.
VtkFrame readVtkFrame(const VtkHeader& header);

// By vtkGhostType; none where it says that of no cell. Throws FileError.
std::vector<bool> readVtkGhostCells(const VtkHeader& header);

// What a variable takes of an array's components.
struct VtkPart {
    enum class Kind { Component, Magnitude } kind = Kind::Component;
    std::size_t component = 0;
};

// Reads this array, and no other where the file lets VTK choose, into field's values and mask.
// The magnitude of float32 is computed in double and kept as float32; of all else it is float64.
// Throws FileError.
void readVtkArray(const VtkHeader& header, const VtkArray& array, VtkPart part,
                  const StridedLayout& layout, Field& field);

}  // namespace timeseries
