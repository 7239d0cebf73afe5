#include "timeseries/readers/vtk_xml_cells.h"

#include <fmt/format.h>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/vtk_xml_numbers.h"

namespace timeseries {
namespace {

// One that is not there stands for none.
std::optional<VtkIndices> indicesOf(const XmlFile& file, const VtkEncoding& encoding,
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
        const VtkIndices found{
            type->type, count ? *count : countVtkValues(file, encoding, array, place, type->bytes)};
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
    return countOf(file, piece, "NumberOfPoints", 0) == 0 &&
           countOf(file, piece, "NumberOfCells", 0) == 0;
}

VtkPiece readVtkPiece(const XmlFile& file, const VtkEncoding& encoding, const XmlElement& piece) {
    VtkPiece found{countOf(file, piece, "NumberOfPoints", 0),
                   countOf(file, piece, "NumberOfCells", 0),
                   {},
                   {},
                   {},
                   {},
                   {}};
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
    return found;
}

}  // namespace timeseries
