// The cells that a piece of an XML unstructured grid, or of polygons, declares, held against the
// file's size.
#pragma once

#include <cstdint>
#include <limits>

#include "timeseries/readers/vtk/vtk_blocks.h"
#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

// What a number in a list of cells means, in a grid of several pieces. What there is not stays so:
// an end beyond all lists, no point, and the type 0, for beyond a byte no shape has a number.
inline std::uint64_t vtkEnd(std::int64_t end, std::uint64_t begin) {
    return end < 0 ? std::numeric_limits<std::uint64_t>::max()
                   : begin + static_cast<std::uint64_t>(end);
}
// Of a piece of so many points, the first of which has the number `first`.
inline std::uint32_t vtkCorner(std::int64_t point, std::uint64_t points, std::uint64_t first) {
    const auto number = static_cast<std::uint64_t>(point);  // below 0 beyond all
    return number < points ? static_cast<std::uint32_t>(first + number) : kNoPoint;
}
inline std::uint8_t vtkShape(std::int64_t type) {
    return type < 0 || type > 255 ? 0 : static_cast<std::uint8_t>(type);
}

// What parallel writers leave for a process that has nothing of the grid.
bool isEmptyVtkPiece(const XmlFile& file, const XmlElement& piece);
// Throws FileError.
VtkPiece readVtkPiece(const XmlFile& file, const VtkEncoding& encoding, const XmlElement& piece);
VtkPiece readVtkPolygons(const XmlFile& file, const VtkEncoding& encoding, const XmlElement& piece);

}  // namespace timeseries
