// What a VTK file declares, checked against its own size before VTK is asked for a value: plain
// data, told by our own look at the XML header or at the lines of a legacy file.
// timeseries/README.md ("One load") says why VTK is not asked.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/vtk/vtk_xml.h"

namespace timeseries {

enum class VtkKind {
    XmlImage,
    XmlRectilinear,
    XmlStructured,
    XmlUnstructured,
    XmlPolygons,
    XmlBlocks,
    LegacyPoints,
    LegacyRectilinear,
    LegacyStructured,
    LegacyUnstructured,
    LegacyPolygons
};
inline bool isStructured(VtkKind kind) {
    return kind == VtkKind::XmlStructured || kind == VtkKind::LegacyStructured;
}

inline bool isUnstructured(VtkKind kind) {
    return kind == VtkKind::XmlUnstructured || kind == VtkKind::XmlPolygons ||
           kind == VtkKind::XmlBlocks || kind == VtkKind::LegacyUnstructured ||
           kind == VtkKind::LegacyPolygons;
}

enum class VtkPlace { Points, Cells };

// How a legacy file introduces an array, by which VTK's reader selects it.
enum class VtkKeyword { Scalars, Vectors, Normals, TextureCoordinates, Tensors, Ids, Field };

struct VtkArray {
    std::string name;
    VtkPlace place{};
    ValueType type{};
    std::size_t components = 1;
    VtkKeyword keyword{};  // of legacy files
    // A word of its text that is no number of its type, for which it cannot be read.
    std::string notNumber = {};
    std::uint64_t fileBytes = 0;  // of an XML file: what all its pieces take of the file
    bool isEverywhere = true;     // not so when a block has it not
};

// An array that tells of places, or in whole numbers of cells: of this type, so many.
struct VtkNumbers {
    ValueType type{};
    std::uint64_t count = 0;
    std::optional<std::uint64_t> rawAt = std::nullopt;  // as rawVtkValuesAt() says
};

// Cells of one kind of a piece of polygons.
struct VtkList {
    std::uint64_t cells = 0;
    VtkNumbers connectivity, offsets;
};

// Faces of polyhedra as VTK writes them since 9.4: where the corners of each face end, the faces of
// one cell behind those of the cell before, and where these end.
struct VtkFaceTables {
    VtkNumbers corners, ends, faces, cellEnds;
};

// A piece of an unstructured grid, or of polygons: "VTK File Formats", Kitware, "UnstructuredGrid",
// "PolyData".
struct VtkPiece {
    std::uint64_t points = 0, cells = 0;
    VtkNumbers places, connectivity, offsets, types;
    std::optional<VtkNumbers> faces, faceOffsets;            // of polyhedra, until VTK 9.3
    std::optional<VtkFaceTables> faceTables = std::nullopt;  // since 9.4
    std::array<VtkList, 3> lists;                            // of polygons: points, lines, surfaces
};

struct VtkTime {
    std::string name;  // "time", or "TimeStep" when steps are numbered
    double value = 0;
};

struct VtkHeader {
    std::filesystem::path path;
    VtkKind kind{};
    std::string format;  // "VTK image data (XML)"
    // The first and last index of the points along x, y and z; not of cells that are listed.
    std::array<std::array<std::int64_t, 2>, 3> extent{};
    std::array<double, 3> origin{0, 0, 0}, spacing{1, 1, 1};
    std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};  // row by row
    std::vector<VtkArray> arrays;                                // those that can be drawn
    std::vector<std::string> passedOver;                         // the others, each with the reason
    std::vector<DamagedVariable> differing;                      // of blocks: of another kind each
    std::array<bool, 2> ghosts{};                                // by VtkPlace: has vtkGhostType
    bool fieldOutside = false;  // a legacy file's FIELD that is neither of points nor of cells
    // Of rectilinear grids; of an XML file VTK reads them later.
    std::array<std::vector<double>, 3> coordinates;
    std::vector<VtkPiece> pieces;  // of cells that are listed: those that hold points
    // Of structured grids, x fastest; VTK reads them later.
    std::vector<glm::dvec3> places;
    UnstructuredGrid unstructured;
    std::vector<bool> ghostCells;      // that are another file's, or hidden; empty: none
    std::vector<bool> pointsOfGhosts;  // those of ghost cells alone; empty: none
    std::optional<VtkTime> time;

    std::array<std::uint64_t, 3> size(VtkPlace place) const;
    std::uint64_t count(VtkPlace place) const;
};

// A step of a list of files.
struct VtkMember {
    std::filesystem::path path;
    std::optional<double> time;
    std::vector<std::filesystem::path> beside = {};  // its other parts, each a file like the first
};

// The sentence "path: place: what".
std::string vtkSentence(const std::filesystem::path& path, std::string_view place,
                        std::string_view what);
[[noreturn]] void failVtk(const std::filesystem::path& path, std::string_view place,
                          std::string_view what);

// Of the points, of the cells and of the field data each: VTK looks for each among the others.
constexpr std::uint64_t kMaxVtkArrays = 4096;
constexpr std::uint64_t kMaxVtkComponents = 1024;

// Each throws FileError when sizes are absurd or exceed the file's.
VtkHeader readVtkLegacyHeader(const std::filesystem::path& path);
VtkHeader readVtkXmlHeader(const XmlFile& file);
bool isVtkCollection(const XmlFile& file);
// In the order of their times; parts of one time, or without any, are one member. Throws FileError.
std::vector<VtkMember> readVtkCollection(const XmlFile& file);
// Throws FileError when the file that `by` names at `place` is that file itself.
void expectOtherVtk(const std::filesystem::path& by, std::string_view place,
                    const std::filesystem::path& named);
// The members of ParaView's JSON.
std::vector<VtkMember> readVtkSeries(const std::filesystem::path& path);
// The members of a list, which has this name in the file. Throws FileError when there are none,
// some have no time, or two have the same.
std::vector<VtkMember> vtkMembersInOrder(const std::filesystem::path& path, std::string_view list,
                                         std::vector<VtkMember> members);

// Shared by the two kinds of header.
struct VtkType {
    std::string_view xml, legacy;
    ValueType type;
    std::size_t bytes;  // of a value in the file
};
const VtkType* vtkXmlType(std::string_view name);
const VtkType* vtkLegacyType(std::string_view lowerCase);
// Whether text is a number of the type. VTK reads none that is not finite, and wraps what is beyond
// the range of a byte or below that of an unsigned type.
bool isVtkNumber(ValueType type, std::string_view text);
bool isVtkGhostName(std::string_view name);
// Throws FileError when there are too many points, none, or too many along an axis.
void checkVtkExtent(const VtkHeader& header, std::string_view place);
// Throws FileError when an unstructured grid has too many points or cells.
void checkVtkCount(const VtkHeader& header, std::string_view place);
// Expects pieces to hold every point or cell: VTK leaves what none holds as it finds it in memory.
// Costs a bit for each, and the pieces, whose values the file holds, declare as many.
void checkVtkCover(const VtkHeader& header, std::span<const VtkHeader> pieces, VtkPlace place);
// Of an element of an XML file.
std::array<std::array<std::int64_t, 2>, 3> vtkExtentOf(const XmlFile& file,
                                                       const XmlElement& element,
                                                       std::string_view attribute);
// What parallel writers leave for a process that has nothing of the grid. VTK is not shown it.
bool isEmptyVtkExtent(const std::array<std::array<std::int64_t, 2>, 3>& extent);
// The name under which a field data array of one number tells the time; nothing when it does not.
std::optional<std::string> vtkTimeName(std::string_view arrayName);
// Of the one step of a file that tells this; of one that tells none it is counted.
TimeAxis vtkTimeAxisOf(const std::optional<VtkTime>& time);

}  // namespace timeseries
