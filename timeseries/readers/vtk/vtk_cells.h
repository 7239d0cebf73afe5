// VTK's readers of XML files of cells that are listed, which decode the lists of cells and do
// nothing with them: VTK 9.1 takes what a damaged file says of its cells for granted.
#pragma once

#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <cstdint>
#include <vector>

#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

class VtkCells {
 public:
    virtual ~VtkCells() = default;
    // Of which the pieces' points and cells are read, and none when it is null. To be called before
    // it reads.
    void expect(const std::vector<VtkPiece>* pieces) { pieces_ = pieces; }
    // All pieces' one behind the other, but for the points.
    virtual UnstructuredGrid takeCells() = 0;

 protected:
    // That which VTK reads now; null where its cells are not.
    const VtkPiece* next() {
        return pieces_ && next_ < pieces_->size() ? &(*pieces_)[next_++] : nullptr;
    }
    std::uint64_t firstPoint_ = 0;

 private:
    const std::vector<VtkPiece>* pieces_ = nullptr;
    std::size_t next_ = 0;
};

class VtkCellReader : public vtkXMLUnstructuredGridReader, public VtkCells {
 public:
    UnstructuredGrid takeCells() override { return std::move(grid_); }

 protected:
    int ReadPieceData() override;

 private:
    // use(i, number) for each of so many; for none where VTK reads something else.
    template <typename Use>
    void forEach(const char* name, const VtkNumbers& expected, const Use& use);
    void addCells(const VtkPiece& piece);
    void addFaces(const VtkPiece& piece);
    void addFaceTables(const VtkPiece& piece);

    UnstructuredGrid grid_;
};

// Points, lines and surfaces, in this order, as the values of cells are.
class VtkPolygonReader : public vtkXMLPolyDataReader, public VtkCells {
 public:
    UnstructuredGrid takeCells() override;

 protected:
    int ReadPieceData() override;

 private:
    template <typename Use>
    void forEach(vtkXMLDataElement* lists, const char* name, const VtkNumbers& expected,
                 const Use& use);

    std::array<UnstructuredGrid, 3> grids_;
};

}  // namespace timeseries
