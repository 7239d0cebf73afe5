#include "timeseries/readers/vtk/vtk_xml_cells.h"

#include <fmt/format.h>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/vtk/vtk_xml_numbers.h"

namespace timeseries {
namespace {

// One that is not there stands for none.
std::optional<VtkNumbers> indicesOf(const XmlFile& file, const VtkEncoding& encoding,
                                    const XmlElement& cells, std::string_view name,
                                    std::optional<std::uint64_t> count) {
    for (const XmlElement& array : cells.children) {
        if (array.attribute("Name") != name) continue;
        const std::string place = fmt::format("{} '{}'", placeOf(array), name);
        const VtkType* type = vtkXmlType(array.attribute("type"));
        const bool whole = type && type->type != ValueType::F32 && type->type != ValueType::F64;
        if (array.name != "DataArray" || !whole ||
            countOf(file, array, "NumberOfComponents", 1) != 1)
            failVtk(file.path, place, "expected a DataArray of whole numbers");
        const VtkNumbers found{
            type->type, count ? *count : countVtkValues(file, encoding, array, place, type->bytes),
            rawVtkValuesAt(file, encoding, array, place)};
        checkVtkValues(file, encoding, array, place, found.count, type->bytes);
        if (!array.notNumber.empty())
            failVtk(file.path, place,
                    fmt::format("expected numbers of its type, found \"{}\"", array.notNumber));
        return found;
    }
    return std::nullopt;
}

}  // namespace

bool isEmptyVtkPiece(const XmlFile& file, const XmlElement& piece) {
    for (const char* what : {"Points", "Cells", "Verts", "Lines", "Polys"})
        if (countOf(file, piece, fmt::format("NumberOf{}", what), 0) > 0) return false;
    return true;
}

VtkPiece readVtkPolygons(const XmlFile& file, const VtkEncoding& encoding,
                         const XmlElement& piece) {
    VtkPiece found;
    found.points = countOf(file, piece, "NumberOfPoints", 0);
    if (countOf(file, piece, "NumberOfStrips", 0) > 0)
        failVtk(file.path, placeOf(piece),
                "expected points, lines and polygons, found triangle strips, which are not read");
    constexpr std::array kKinds{"Verts", "Lines", "Polys"};
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
        VtkList& list = found.lists[k];
        list.cells = countOf(file, piece, fmt::format("NumberOf{}", kKinds[k]), 0);
        found.cells += list.cells;
        const auto groups = named(piece, kKinds[k]);
        if (groups.size() > 1 || (groups.empty() && list.cells > 0))
            failVtk(file.path, placeOf(piece), fmt::format("expected one list of {}", kKinds[k]));
        if (list.cells == 0) continue;
        const auto connectivity =
                       indicesOf(file, encoding, *groups[0], "connectivity", std::nullopt),
                   offsets = indicesOf(file, encoding, *groups[0], "offsets", list.cells);
        if (!connectivity || !offsets)
            failVtk(file.path, placeOf(*groups[0]), "expected connectivity and offsets");
        list.connectivity = *connectivity;
        list.offsets = *offsets;
    }
    // VTK is not shown a piece without points.
    if (found.points == 0 && found.cells > 0)
        failVtk(file.path, placeOf(piece), "expected the points of its cells, found none");
    return found;
}

VtkPiece readVtkPiece(const XmlFile& file, const VtkEncoding& encoding, const XmlElement& piece) {
    VtkPiece found;
    found.points = countOf(file, piece, "NumberOfPoints", 0);
    found.cells = countOf(file, piece, "NumberOfCells", 0);
    const auto groups = named(piece, "Cells");
    if (groups.size() > 1 || (groups.empty() && found.cells > 0))
        failVtk(file.path, placeOf(piece), "expected one list of Cells");
    if (groups.empty() || found.cells == 0) return found;
    const XmlElement& cells = *groups[0];
    const auto read = [&](std::string_view name, std::optional<std::uint64_t> count) {
        return indicesOf(file, encoding, cells, name, count);
    };
    const auto connectivity = read("connectivity", std::nullopt),
               offsets = read("offsets", found.cells), types = read("types", found.cells);
    if (!connectivity || !offsets || !types)
        failVtk(file.path, placeOf(cells), "expected connectivity, offsets and types");
    found.connectivity = *connectivity;
    found.offsets = *offsets;
    found.types = *types;
    found.faces = read("faces", std::nullopt);
    if (found.faces) found.faceOffsets = read("faceoffsets", found.cells);
    if (found.faces && !found.faceOffsets)
        failVtk(file.path, placeOf(cells), "expected faceoffsets beside faces");
    const auto corners = read("face_connectivity", std::nullopt);
    if (!corners || corners->count == 0 || found.faces) return found;
    const auto ends = read("face_offsets", std::nullopt),
               faces = read("polyhedron_to_faces", std::nullopt),
               cellEnds = read("polyhedron_offsets", found.cells);
    if (!ends || !faces || !cellEnds)
        failVtk(file.path, placeOf(cells),
                "expected face_offsets, polyhedron_to_faces and polyhedron_offsets beside "
                "face_connectivity");
    found.faceTables = {*corners, *ends, *faces, *cellEnds};
    return found;
}

}  // namespace timeseries
