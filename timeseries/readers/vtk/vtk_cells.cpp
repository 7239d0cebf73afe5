#include "timeseries/readers/vtk/vtk_cells.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <utility>

#include "timeseries/readers/face_tables.h"
#include "timeseries/readers/vtk/vtk_xml_cells.h"

namespace timeseries {
namespace {

// use(i, number) for each of so many that `read` puts there; for none where it does not.
template <typename Use, typename Read>
void forEachOf(vtkAbstractArray* array, const VtkNumbers& expected, const Use& use,
               const Read& read) {
    auto* data = vtkDataArray::SafeDownCast(array);
    const auto count = static_cast<vtkIdType>(expected.count);
    if (!data || data->GetNumberOfComponents() != 1) return;
    data->SetNumberOfTuples(count);
    if (count > 0 && !read(data, count)) return;
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

// Where they stand in a grid whose cells are of one list, behind those that are there.
template <typename ForEach>
void addList(UnstructuredGrid& grid, std::uint64_t count, const VtkNumbers& connectivity,
             const VtkNumbers& offsets, std::uint64_t points, std::uint64_t firstPoint,
             const ForEach& forEach) {
    const std::uint64_t cells = grid.ends.size(), corners = grid.corners.size();
    grid.ends.resize(cells + count, 0);
    grid.corners.resize(corners + connectivity.count, kNoPoint);
    forEach("offsets", offsets, [&](std::uint64_t i, std::int64_t end) {
        grid.ends[cells + i] = vtkEnd(end, corners);
    });
    forEach("connectivity", connectivity, [&](std::uint64_t i, std::int64_t point) {
        auto& corner = grid.corners[corners + i];
        corner = vtkCorner(point, points, firstPoint);
        if (corner == kNoPoint) grid.keepFirst({corners + i, point, points});
    });
}

}  // namespace

template <typename Use>
void VtkCellReader::forEach(const char* name, const VtkNumbers& expected, const Use& use) {
    vtkXMLDataElement* element = FindDataArrayWithName(CellElements[Piece], name);
    const auto array =
        vtkSmartPointer<vtkAbstractArray>::Take(element ? CreateArray(element) : nullptr);
    forEachOf(array, expected, use, [&](vtkDataArray* data, vtkIdType count) {
        return ReadArrayValues(element, 0, data, 0, count);
    });
}

void VtkCellReader::addCells(const VtkPiece& piece) {
    const std::uint64_t cells = grid_.types.size();
    addList(grid_, piece.cells, piece.connectivity, piece.offsets, piece.points, firstPoint_,
            [&](const char* name, const VtkNumbers& expected, const auto& use) {
                forEach(name, expected, use);
            });
    grid_.types.resize(cells + piece.cells, 0);
    forEach("types", piece.types,
            [&](std::uint64_t i, std::int64_t type) { grid_.types[cells + i] = vtkShape(type); });
}

// The lists of a cell are a number of faces, and of each how many points it has, and which.
void VtkCellReader::addFaces(const VtkPiece& piece) {
    const std::uint64_t cells = grid_.types.size(), before = grid_.faces.size();
    if (piece.faceTables) return addFaceTables(piece);
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

void VtkCellReader::addFaceTables(const VtkPiece& piece) {
    const VtkFaceTables& expected = *piece.faceTables;
    FaceTables tables{std::vector<std::uint32_t>(expected.corners.count, kNoPoint),
                      std::vector<std::uint64_t>(expected.ends.count),
                      std::vector<std::uint64_t>(expected.faces.count),
                      std::vector<std::uint64_t>(piece.cells)};
    forEach("face_connectivity", expected.corners, [&](std::uint64_t i, std::int64_t point) {
        tables.corners[i] = vtkCorner(point, piece.points, firstPoint_);
    });
    const auto take = [](std::vector<std::uint64_t>& to) {
        return [&to](std::uint64_t i, std::int64_t number) { to[i] = vtkEnd(number, 0); };
    };
    forEach("face_offsets", expected.ends, take(tables.ends));
    forEach("polyhedron_to_faces", expected.faces, take(tables.faces));
    forEach("polyhedron_offsets", expected.cellEnds, take(tables.cellEnds));
    timeseries::addFaces(tables, grid_);
}

int VtkCellReader::ReadPieceData() {
    const VtkPiece* const piece = next();
    if (!piece) return vtkXMLDataReader::ReadPieceData();
    if (!vtkXMLUnstructuredDataReader::ReadPieceData()) return 0;
    if (piece->cells > 0) {
        addCells(*piece);
        addFaces(*piece);
    }
    firstPoint_ += piece->points;
    return 1;
}

template <typename Use>
void VtkPolygonReader::forEach(vtkXMLDataElement* lists, const char* name,
                               const VtkNumbers& expected, const Use& use) {
    vtkXMLDataElement* element = lists ? FindDataArrayWithName(lists, name) : nullptr;
    const auto array =
        vtkSmartPointer<vtkAbstractArray>::Take(element ? CreateArray(element) : nullptr);
    forEachOf(array, expected, use, [&](vtkDataArray* data, vtkIdType count) {
        return ReadArrayValues(element, 0, data, 0, count);
    });
}

int VtkPolygonReader::ReadPieceData() {
    constexpr std::array<std::uint8_t, 3> kShapes{2, 4, 7};  // cell_types.h
    const VtkPiece* const piece = next();
    if (!piece) return vtkXMLDataReader::ReadPieceData();
    if (!vtkXMLUnstructuredDataReader::ReadPieceData()) return 0;
    const std::array elements{VertElements[Piece], LineElements[Piece], PolyElements[Piece]};
    for (std::size_t k = 0; k < kShapes.size(); ++k) {
        const VtkList& list = piece->lists[k];
        if (list.cells == 0) continue;
        addList(grids_[k], list.cells, list.connectivity, list.offsets, piece->points, firstPoint_,
                [&](const char* name, const VtkNumbers& expected, const auto& use) {
                    forEach(elements[k], name, expected, use);
                });
        grids_[k].types.resize(grids_[k].ends.size(), kShapes[k]);
    }
    firstPoint_ += piece->points;
    return 1;
}

UnstructuredGrid VtkPolygonReader::takeCells() {
    UnstructuredGrid all = std::move(grids_[0]);
    for (const std::size_t k : {1u, 2u}) {
        const std::uint64_t corners = all.corners.size();
        const UnstructuredGrid more = std::move(grids_[k]);
        all.types.insert(all.types.end(), more.types.begin(), more.types.end());
        all.corners.insert(all.corners.end(), more.corners.begin(), more.corners.end());
        if (const auto& none = more.noPoint)
            all.keepFirst({corners + none->corner, none->number, none->points});
        for (const std::uint64_t end : more.ends)
            all.ends.push_back(vtkEnd(static_cast<std::int64_t>(end), corners));
    }
    return all;
}

}  // namespace timeseries
