// VTK's reader of XML unstructured grids, which decodes the lists of cells and does nothing with
// them: VTK 9.1 takes what a damaged file says of its cells for granted.
#pragma once

#include <vtkXMLUnstructuredGridReader.h>

#include <cstdint>
#include <vector>

#include "timeseries/readers/vtk_header.h"

namespace timeseries {

class VtkCellReader : public vtkXMLUnstructuredGridReader {
 public:
    // Of which the pieces' cells are read, and none when it is null. To be called before it reads.
    void expect(const std::vector<VtkPiece>* pieces) { pieces_ = pieces; }
    // All pieces' one behind the other, but for the points.
    UnstructuredGrid takeCells() { return std::move(grid_); }

 protected:
    int ReadPieceData() override;

 private:
    // use(i, number) for each of so many; for none where VTK reads something else.
    template <typename Use>
    void forEach(const char* name, const VtkIndices& expected, const Use& use);
    void addCells(const VtkPiece& piece);
    void addFaces(const VtkPiece& piece);

    const std::vector<VtkPiece>* pieces_ = nullptr;
    std::size_t next_ = 0;
    std::uint64_t firstPoint_ = 0;
    UnstructuredGrid grid_;
};

}  // namespace timeseries
