#include "timeseries/readers/vtk_cells.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <limits>
#include <stdexcept>

namespace timeseries {
namespace {

std::uint64_t endOf(std::int64_t end, std::uint64_t begin) {
    // What is beyond all lists is told as such, whatever it is.
    return end < 0 ? std::numeric_limits<std::uint64_t>::max()
                   : begin + static_cast<std::uint64_t>(end);
}

}  // namespace

template <typename Use>
void VtkCellReader::forEach(const char* name, const VtkIndices& expected, const Use& use) {
    vtkXMLDataElement* element = FindDataArrayWithName(CellElements[Piece], name);
    const auto array =
        vtkSmartPointer<vtkAbstractArray>::Take(element ? CreateArray(element) : nullptr);
    auto* data = vtkDataArray::SafeDownCast(array);
    const auto count = static_cast<vtkIdType>(expected.count);
    if (!data || data->GetNumberOfComponents() != 1) return;
    data->SetNumberOfTuples(count);
    if (count > 0 && !ReadArrayValues(element, 0, data, 0, count)) return;
    const auto take = [&](auto* values) {
        for (std::uint64_t i = 0; i < expected.count; ++i)
            use(i, static_cast<std::int64_t>(values[i]));
    };
    switch (data->GetDataType()) {
        vtkTemplateMacro(take(static_cast<VTK_TT*>(data->GetVoidPointer(0))));
        default:
            break;
    }
}

void VtkCellReader::addCells(const VtkPiece& piece) {
    const std::uint64_t cells = grid_.types.size(), corners = grid_.corners.size();
    grid_.ends.resize(cells + piece.cells);
    grid_.types.resize(cells + piece.cells);
    grid_.corners.resize(corners + piece.connectivity.count, kNoPoint);
    forEach("offsets", piece.offsets, [&](std::uint64_t i, std::int64_t end) {
        grid_.ends[cells + i] = endOf(end, corners);
    });
    forEach("types", piece.types, [&](std::uint64_t i, std::int64_t type) {
        // Beyond a byte no shape has a number.
        grid_.types[cells + i] = type < 0 || type > 255 ? 0 : static_cast<std::uint8_t>(type);
    });
    forEach("connectivity", piece.connectivity, [&](std::uint64_t i, std::int64_t point) {
        if (point >= 0 && static_cast<std::uint64_t>(point) < piece.points)
            grid_.corners[corners + i] = static_cast<std::uint32_t>(firstPoint_ + point);
    });
}

// The lists of a cell are a number of faces, and of each how many points it has, and which.
void VtkCellReader::addFaces(const VtkPiece& piece) {
    const std::uint64_t cells = grid_.types.size(), before = grid_.faces.size();
    if (!piece.faces || !piece.faceOffsets) {
        if (!grid_.faceEnds.empty()) grid_.faceEnds.resize(cells, before);
        return;
    }
    grid_.faceEnds.resize(cells - piece.cells, before);
    std::vector<std::uint64_t> ends(piece.cells);
    std::uint64_t end = 0;  // that of a cell without faces is -1
    forEach("faceoffsets", *piece.faceOffsets, [&](std::uint64_t i, std::int64_t each) {
        if (each >= 0) end = static_cast<std::uint64_t>(each);
        ends[i] = end;
        grid_.faceEnds.push_back(before + end);
    });
    grid_.faceEnds.resize(cells, before + end);
    grid_.faces.resize(before + piece.faces->count, kNoPoint);
    // Counts stay, and points are those of all pieces. A list begins with how many faces it has.
    std::size_t cell = 0;
    std::int64_t points = 0;
    std::uint64_t begin = 0;
    forEach("faces", *piece.faces, [&](std::uint64_t i, std::int64_t number) {
        while (cell < ends.size() && ends[cell] <= i) {
            begin = i;
            points = 0;
            ++cell;
        }
        const bool isPoint = points > 0;
        if (isPoint)
            --points;
        else if (i > begin)
            points = number;
        const std::int64_t most = isPoint ? static_cast<std::int64_t>(piece.points) : kNoPoint;
        if (number >= 0 && number < most)
            grid_.faces[before + i] =
                static_cast<std::uint32_t>(number + (isPoint ? firstPoint_ : 0));
    });
}

int VtkCellReader::ReadPieceData() {
    if (!vtkXMLUnstructuredDataReader::ReadPieceData()) return 0;
    if (!pieces_ || next_ >= pieces_->size()) return 1;
    const VtkPiece& piece = (*pieces_)[next_++];
    if (piece.cells > 0) {
        addCells(piece);
        addFaces(piece);
    }
    firstPoint_ += piece.points;
    return 1;
}

}  // namespace timeseries
