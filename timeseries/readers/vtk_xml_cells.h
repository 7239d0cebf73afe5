// The cells that a piece of an XML unstructured grid, or of polygons, declares, held against the
// file's size.
#pragma once

#include "timeseries/readers/vtk_blocks.h"
#include "timeseries/readers/vtk_header.h"

namespace timeseries {

// What parallel writers leave for a process that has nothing of the grid.
bool isEmptyVtkPiece(const XmlFile& file, const XmlElement& piece);
// Throws FileError.
VtkPiece readVtkPiece(const XmlFile& file, const VtkEncoding& encoding, const XmlElement& piece);
VtkPiece readVtkPolygons(const XmlFile& file, const VtkEncoding& encoding, const XmlElement& piece);

}  // namespace timeseries
