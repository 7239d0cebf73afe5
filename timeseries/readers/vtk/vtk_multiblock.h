// Files that name the blocks of one whole, each a file of its own: multi-block data sets (.vtm),
// partitioned ones (.vtpd, .vtpc), and adaptive meshes, whose levels lie over each other (.vth,
// .vthb). "VTK XML Formats", Kitware, and vtkXMLCompositeDataReader.
#pragma once

#include <string_view>
#include <vector>

#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

// Of the root.
bool isVtkMultiBlock(std::string_view type);

struct VtkBlocks {
    std::string format;             // "VTK multi-block data"
    std::size_t levels = 0;         // of an adaptive mesh; else 0
    std::vector<VtkHeader> blocks;  // with places, coordinates and cells; none is empty
    // By block and VtkPlace: what finer levels cover. Empty where nothing is.
    std::vector<std::array<std::vector<bool>, 2>> covered;
};
// Throws FileError.
VtkBlocks readVtkBlocks(const XmlFile& file);
// Of blocks that a collection lists as the parts of one step. Throws FileError.
VtkBlocks readVtkParts(const VtkMember& step);

// The cells of a block of any kind, one by one, but for those that are covered: `unstructured` and
// `pieces` of its header.
void listVtkCells(VtkHeader& block, const std::vector<bool>& covered);

}  // namespace timeseries
