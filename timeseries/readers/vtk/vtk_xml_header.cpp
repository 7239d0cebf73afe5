// The headers of VTK XML files.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "timeseries/readers/other_formats.h"
#include "timeseries/readers/vtk/vtk_blocks.h"
#include "timeseries/readers/vtk/vtk_header.h"
#include "timeseries/readers/vtk/vtk_xml_cells.h"
#include "timeseries/readers/vtk/vtk_xml_numbers.h"

namespace timeseries {
namespace {

struct Context {
    const XmlFile& file;
    VtkEncoding encoding;
    VtkHeader& header;
};

// Counts what one more of several, which VTK holds together, takes in the file. Each is there, but
// all may name the same bytes, and so stand for far more values than the file has.
void claim(const Context& context, std::uint64_t& claimed, std::string_view place,
           std::uint64_t bytes) {
    claimed += bytes;
    if (claimed > context.file.bytes)
        failVtk(context.file.path, place,
                fmt::format("expected values of its own, but with those before it they are {} "
                            "bytes in a file of {}",
                            claimed, context.file.bytes));
}

// The name that VTK gives an array without one.
std::string nameOf(const XmlElement& array, std::size_t index) {
    return array.has("Name") ? std::string(array.attribute("Name"))
                             : fmt::format("Array {}", index);
}

// One array of PointData or CellData, its values checked; nothing when it cannot be drawn.
std::optional<VtkArray> arrayOf(const Context& context, const XmlElement& element, std::string name,
                                VtkPlace place, std::uint64_t tuples) {
    const std::string where = fmt::format("{} '{}'", placeOf(element), name);
    const std::uint64_t components = countOf(context.file, element, "NumberOfComponents", 1);
    const VtkType* type = vtkXmlType(element.attribute("type"));
    if (element.name != "DataArray" || !type) {
        context.header.passedOver.push_back(
            fmt::format("'{}' has the type {}", name,
                        element.name == "DataArray" ? element.attribute("type") : element.name));
        return std::nullopt;
    }
    if (components < 1 || components > kMaxVtkComponents)
        failVtk(
            context.file.path, where,
            fmt::format("expected 1 to {} components, found {}", kMaxVtkComponents, components));
    if (element.has("TimeStep"))
        failVtk(context.file.path, where,
                "expected one time step in a file, found an array of one of several");
    const std::uint64_t bytes = checkVtkValues(context.file, context.encoding, element, where,
                                               tuples * components, type->bytes);
    return VtkArray{std::move(name), place, type->type, components, {}, element.notNumber, bytes};
}

void checkArrayCount(const Context& context, const XmlElement& group) {
    if (group.children.size() > kMaxVtkArrays)
        failVtk(context.file.path, placeOf(group),
                fmt::format("expected at most {} arrays, found {}", kMaxVtkArrays,
                            group.children.size()));
}

// The arrays of one piece at points or at cells, by name.
std::vector<VtkArray> arraysOf(const Context& context, const XmlElement& piece, VtkPlace place,
                               std::uint64_t tuples) {
    const std::string_view group = place == VtkPlace::Points ? "PointData" : "CellData";
    const auto groups = named(piece, group);
    if (groups.size() > 1)
        failVtk(context.file.path, placeOf(*groups[1]), "expected one in a piece");
    if (!groups.empty()) checkArrayCount(context, *groups[0]);
    std::vector<VtkArray> arrays;
    std::set<std::string> names;
    for (std::size_t i = 0; !groups.empty() && i < groups[0]->children.size(); ++i) {
        const XmlElement& element = groups[0]->children[i];
        std::string name = nameOf(element, i);
        if (!names.insert(name).second)
            failVtk(context.file.path, placeOf(element),
                    fmt::format("expected names that differ, found '{}' again", name));
        if (auto array = arrayOf(context, element, std::move(name), place, tuples))
            arrays.push_back(std::move(*array));
    }
    return arrays;
}

// Of the coordinates of a grid.
VtkNumbers checkedNumbers(const Context& context, const XmlElement& array, std::uint64_t components,
                          std::uint64_t tuples) {
    const VtkType* type = vtkXmlType(array.attribute("type"));
    if (array.name != "DataArray" || !type ||
        countOf(context.file, array, "NumberOfComponents", 1) != components)
        failVtk(context.file.path, placeOf(array),
                components == 1 ? "expected a DataArray of numbers"
                                : "expected a DataArray of 3 components, x, y and z");
    checkVtkValues(context.file, context.encoding, array, placeOf(array), components * tuples,
                   type->bytes);
    if (!array.notNumber.empty())
        failVtk(context.file.path, placeOf(array),
                fmt::format("expected finite numbers of its type, found \"{}\"", array.notNumber));
    return {type->type, components * tuples,
            rawVtkValuesAt(context.file, context.encoding, array, placeOf(array))};
}

VtkNumbers checkedPoints(const Context& context, const XmlElement& piece, const VtkHeader& shape) {
    const auto groups = named(piece, "Points");
    if (groups.size() != 1 || groups[0]->children.size() != 1)
        failVtk(context.file.path, placeOf(piece), "expected Points of one array");
    return checkedNumbers(context, groups[0]->children[0], 3, shape.count(VtkPlace::Points));
}

void checkCoordinates(const Context& context, const XmlElement& piece, const VtkHeader& shape) {
    const auto groups = named(piece, "Coordinates");
    if (groups.size() != 1 || groups[0]->children.size() != 3)
        failVtk(context.file.path, placeOf(piece),
                "expected Coordinates of three arrays, x, y and z");
    const auto size = shape.size(VtkPlace::Points);
    for (std::size_t i = 0; i < 3; ++i) checkedNumbers(context, groups[0]->children[i], 1, size[i]);
}

// VTK 9.1 makes every array of the field data, and crashes when it knows its type not.
void checkFieldData(const Context& context, const XmlElement& grid) {
    std::uint64_t claimed = 0;
    for (const XmlElement* field : named(grid, "FieldData")) {
        checkArrayCount(context, *field);
        for (const XmlElement& array : field->children) {
            const std::string_view name = array.attribute("type");
            const VtkType* type = vtkXmlType(name);
            if (!type && name != "String" && name != "Bit")
                failVtk(context.file.path, placeOf(array),
                        fmt::format("expected a type that VTK knows, found \"{}\"", name));
            const std::uint64_t tuples = countOf(context.file, array, "NumberOfTuples", 0);
            const std::uint64_t components = countOf(context.file, array, "NumberOfComponents", 1);
            if (components < 1 || components > kMaxVtkComponents)
                failVtk(context.file.path, placeOf(array), "expected fewer components");
            if (type)
                claim(context, claimed, placeOf(array),
                      checkVtkValues(context.file, context.encoding, array, placeOf(array),
                                     tuples * components, type->bytes));
            else if (tuples * components > context.file.bytes)
                failVtk(context.file.path, placeOf(array),
                        fmt::format("expected values within the file, found {} of them",
                                    tuples * components));
        }
    }
}

void checkInside(const VtkHeader& header, const XmlElement& piece, const VtkHeader& shape) {
    for (std::size_t i = 0; i < 3; ++i)
        if (shape.extent[i][0] < header.extent[i][0] || shape.extent[i][1] > header.extent[i][1])
            failVtk(header.path, placeOf(piece), "expected an Extent inside WholeExtent");
}

void addPieces(const Context& context, const XmlElement& grid) {
    VtkHeader& header = context.header;
    std::vector<VtkHeader> shapes;
    for (const XmlElement* piece : named(grid, "Piece")) {
        VtkHeader shape;
        shape.path = header.path;
        shape.kind = header.kind;
        if (isUnstructured(header.kind)) {
            if (isEmptyVtkPiece(context.file, *piece)) continue;
            const auto read = header.kind == VtkKind::XmlPolygons ? readVtkPolygons : readVtkPiece;
            shape.pieces = {read(context.file, context.encoding, *piece)};
            shape.pieces[0].places = checkedPoints(context, *piece, shape);
        } else {
            shape.extent = vtkExtentOf(context.file, *piece, "Extent");
            if (isEmptyVtkExtent(shape.extent)) continue;
            checkInside(header, *piece, shape);
        }
        if (header.kind == VtkKind::XmlRectilinear) checkCoordinates(context, *piece, shape);
        if (header.kind == VtkKind::XmlStructured) checkedPoints(context, *piece, shape);
        std::vector<VtkArray> arrays;
        for (const VtkPlace place : {VtkPlace::Points, VtkPlace::Cells})
            for (VtkArray& array : arraysOf(context, *piece, place, shape.count(place)))
                arrays.push_back(std::move(array));
        const auto same = [](const VtkArray& a, const VtkArray& b) {
            return a.name == b.name && a.place == b.place && a.type == b.type &&
                   a.components == b.components;
        };
        if (shapes.empty())
            header.arrays = arrays;
        else if (!std::ranges::equal(arrays, header.arrays, same))
            failVtk(header.path, placeOf(*piece), "expected the arrays of the first piece");
        for (std::size_t i = 0; !shapes.empty() && i < arrays.size(); ++i) {
            VtkArray& array = header.arrays[i];
            claim(context, array.fileBytes, fmt::format("{} '{}'", placeOf(*piece), array.name),
                  arrays[i].fileBytes);
            if (array.notNumber.empty()) array.notNumber = arrays[i].notNumber;
        }
        header.pieces.insert(header.pieces.end(), shape.pieces.begin(), shape.pieces.end());
        shapes.push_back(std::move(shape));
    }
    checkVtkCount(header, placeOf(grid));
    if (shapes.empty())
        failVtk(header.path, placeOf(grid), "expected a Piece that holds points, found none");
    for (const VtkPlace place : {VtkPlace::Points, VtkPlace::Cells}) {
        if (isUnstructured(header.kind)) break;  // its pieces are all that there is
        const bool hasPlaces = isStructured(header.kind) && place == VtkPlace::Points;
        const auto isThere = [&](const VtkArray& array) { return array.place == place; };
        if (hasPlaces || std::ranges::any_of(header.arrays, isThere))
            checkVtkCover(header, shapes, place);
    }
    std::ranges::sort(header.passedOver);
    header.passedOver.erase(std::unique(header.passedOver.begin(), header.passedOver.end()),
                            header.passedOver.end());
    std::erase_if(header.arrays, [&](const VtkArray& array) {
        if (!isVtkGhostName(array.name)) return false;
        header.ghosts[static_cast<std::size_t>(array.place)] = true;
        return true;
    });
}

}  // namespace

bool isEmptyVtkExtent(const std::array<std::array<std::int64_t, 2>, 3>& extent) {
    return std::ranges::any_of(extent, [](const auto& axis) { return axis[1] < axis[0]; });
}

std::array<std::array<std::int64_t, 2>, 3> vtkExtentOf(const XmlFile& file,
                                                       const XmlElement& element,
                                                       std::string_view attribute) {
    const auto n = numbersOf<std::int32_t>(file, element, attribute, 6);
    return {{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}}};
}

void checkVtkCover(const VtkHeader& header, std::span<const VtkHeader> pieces, VtkPlace place) {
    const std::uint64_t all = header.count(place);
    const auto whole = header.size(place);
    std::uint64_t found = 0;
    for (const VtkHeader& piece : pieces) found += piece.count(place);
    if (found >= all && pieces.size() > 1) {
        std::vector<bool> held(all);
        for (const VtkHeader& piece : pieces) {
            const auto size = piece.size(place);
            std::array<std::uint64_t, 3> first{};
            bool flat = false;  // one layer of points within a thick grid: no cells
            for (std::size_t i = 0; i < 3; ++i) {
                first[i] = static_cast<std::uint64_t>(piece.extent[i][0] - header.extent[i][0]);
                flat |= place == VtkPlace::Cells && piece.extent[i][0] == piece.extent[i][1] &&
                        header.extent[i][0] != header.extent[i][1];
            }
            for (std::uint64_t z = 0; z < (flat ? 0 : size[2]); ++z)
                for (std::uint64_t y = 0; y < size[1]; ++y) {
                    const auto row =
                        held.begin() +
                        static_cast<std::ptrdiff_t>(
                            ((first[2] + z) * whole[1] + first[1] + y) * whole[0] + first[0]);
                    std::fill(row, row + static_cast<std::ptrdiff_t>(size[0]), true);
                }
        }
        found = static_cast<std::uint64_t>(std::count(held.begin(), held.end(), true));
    }
    if (found < all)
        failVtk(header.path, "Piece",
                fmt::format("expected pieces that fill WholeExtent, found {} of its {} {}", found,
                            all, place == VtkPlace::Points ? "points" : "cells"));
}

VtkHeader readVtkXmlHeader(const XmlFile& file) {
    const XmlElement& root = rootOf(file);
    const std::string_view type = root.attribute("type");
    VtkHeader header;
    header.path = file.path;
    if (const std::string other = otherVtkType(type); !other.empty())
        throw FileError(notReadSentence(file.path, other));
    struct Known {
        std::string_view type;
        VtkKind kind;
        const char* format;
    };
    constexpr std::array kKnown{
        Known{"ImageData", VtkKind::XmlImage, "VTK image data (XML)"},
        Known{"RectilinearGrid", VtkKind::XmlRectilinear, "VTK rectilinear grid (XML)"},
        Known{"StructuredGrid", VtkKind::XmlStructured, "VTK structured grid (XML)"},
        Known{"UnstructuredGrid", VtkKind::XmlUnstructured, "VTK unstructured grid (XML)"},
        Known{"PolyData", VtkKind::XmlPolygons, "VTK polygons (XML)"}};
    const auto known = std::ranges::find(kKnown, type, &Known::type);
    if (known == kKnown.end())
        failVtk(file.path, "VTKFile",
                fmt::format("expected the type ImageData, RectilinearGrid, StructuredGrid, "
                            "UnstructuredGrid, PolyData or Collection, found \"{}\"",
                            type));
    header.kind = known->kind;
    header.format = known->format;
    const auto grids = named(root, type);
    if (grids.size() != 1)
        failVtk(file.path, "VTKFile", fmt::format("expected one {}, found {}", type, grids.size()));
    const XmlElement& grid = *grids[0];
    if (!isUnstructured(header.kind)) {
        header.extent = vtkExtentOf(file, grid, "WholeExtent");
        checkVtkExtent(header, placeOf(grid) + " WholeExtent");
    }
    if (grid.has("TimeValues"))
        failVtk(file.path, placeOf(grid), "expected one time step in a file, found TimeValues");

    const auto take = [&](std::string_view name, auto& numbers) {
        if (!grid.has(name)) return;
        std::ranges::copy(numbersOf<double>(file, grid, name, numbers.size()), numbers.begin());
    };
    if (header.kind == VtkKind::XmlImage) {
        take("Origin", header.origin);
        take("Spacing", header.spacing);
        take("Direction", header.direction);
    }
    const Context context{file, vtkEncodingOf(file), header};
    checkFieldData(context, grid);
    addPieces(context, grid);
    return header;
}

}  // namespace timeseries
