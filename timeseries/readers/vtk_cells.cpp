#include "timeseries/readers/vtk_cells.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <limits>
#include <stdexcept>

namespace timeseries {
namespace {

// What stands where no point is, so that it is told as one that there is not.
constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();

std::uint64_t endOf(std::int64_t end, std::uint64_t begin) {
    // What is beyond all lists is told as such, whatever it is.
    return end < 0 ? std::numeric_limits<std::uint64_t>::max()
                   : begin + static_cast<std::uint64_t>(end);
}

}  // namespace

std::vector<std::int64_t> VtkCellReader::numbers(const char* name, const VtkIndices& expected) {
    vtkXMLDataElement* element = FindDataArrayWithName(CellElements[Piece], name);
    const auto array =
        vtkSmartPointer<vtkAbstractArray>::Take(element ? CreateArray(element) : nullptr);
    auto* data = vtkDataArray::SafeDownCast(array);
    const auto count = static_cast<vtkIdType>(expected.count);
    if (!data || data->GetNumberOfComponents() != 1) return {};
    data->SetNumberOfTuples(count);
    if (count > 0 && !ReadArrayValues(element, 0, data, 0, count)) return {};
    std::vector<std::int64_t> numbers(expected.count);
    const auto take = [&](auto* values) {
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i] = static_cast<std::int64_t>(values[i]);
    };
    switch (data->GetDataType()) {
        vtkTemplateMacro(take(static_cast<VTK_TT*>(data->GetVoidPointer(0))));
        default:
            return {};
    }
    return numbers;
}

void VtkCellReader::addCells(const VtkPiece& piece) {
    const std::uint64_t before = grid_.corners.size();
    for (const std::int64_t end : numbers("offsets", piece.offsets))
        grid_.ends.push_back(endOf(end, before));
    for (const std::int64_t type : numbers("types", piece.types))
        grid_.types.push_back(static_cast<std::uint8_t>(type));
    for (const std::int64_t point : numbers("connectivity", piece.connectivity))
        grid_.corners.push_back(point < 0 || static_cast<std::uint64_t>(point) >= piece.points
                                    ? kNoPoint
                                    : static_cast<std::uint32_t>(firstPoint_ + point));
}

// The lists of a cell are a number of faces, and of each how many points it has, and which.
void VtkCellReader::addFaces(const VtkPiece& piece) {
    const std::uint64_t cells = grid_.types.size();
    const auto fill = [&](std::uint64_t until) {
        grid_.faceEnds.resize(until, grid_.faces.size());
    };
    if (!piece.faces || !piece.faceOffsets) {
        if (!grid_.faceEnds.empty()) fill(cells);
        return;
    }
    fill(cells - piece.cells);
    const std::uint64_t before = grid_.faces.size();
    std::uint64_t end = before;  // that of a cell without faces is -1
    const auto ends = numbers("faceoffsets", *piece.faceOffsets);
    const auto faces = numbers("faces", *piece.faces);
    std::uint64_t next = 0;
    for (const std::int64_t each : ends) {
        if (each >= 0) end = endOf(each, before);
        grid_.faceEnds.push_back(end);
        // Counts stay, and points are those of all pieces.
        const auto last = std::min<std::uint64_t>(
            each < 0 ? next : static_cast<std::uint64_t>(each), faces.size());
        std::int64_t points = 0;
        for (const std::uint64_t first = next; next < last; ++next) {
            std::int64_t number = faces[next];
            const bool isPoint = points > 0;
            if (isPoint)
                --points, number += static_cast<std::int64_t>(firstPoint_);
            else if (next > first)
                points = number;
            const bool fits = number >= 0 && number < kNoPoint &&
                              (!isPoint || faces[next] < static_cast<std::int64_t>(piece.points));
            grid_.faces.push_back(fits ? static_cast<std::uint32_t>(number) : kNoPoint);
        }
    }
    grid_.faces.resize(before + faces.size(), kNoPoint);
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
