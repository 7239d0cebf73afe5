#include "timeseries/grid/cell_types.h"

#include <fmt/format.h>

#include <array>

namespace timeseries {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 1> kPixelSizes{4};
constexpr std::array<std::uint8_t, 4> kPixel{0, 1, 3, 2};
constexpr std::array<std::uint8_t, 4> kTetraSizes{3, 3, 3, 3};
constexpr std::array<std::uint8_t, 12> kTetra{0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1};
constexpr std::array<std::uint8_t, 6> kBoxSizes{4, 4, 4, 4, 4, 4};
constexpr std::array<std::uint8_t, 24> kHexahedron{0, 4, 7, 3, 1, 2, 6, 5, 0, 1, 5, 4,
                                                   3, 7, 6, 2, 0, 3, 2, 1, 4, 5, 6, 7};
constexpr std::array<std::uint8_t, 24> kVoxel{0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4,
                                              2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
constexpr std::array<std::uint8_t, 5> kWedgeSizes{3, 3, 4, 4, 4};
constexpr std::array<std::uint8_t, 18> kWedge{0, 1, 2, 3, 5, 4, 0, 3, 4, 1, 1, 4, 5, 2, 2, 5, 3, 0};
constexpr std::array<std::uint8_t, 5> kPyramidSizes{4, 3, 3, 3, 3};
constexpr std::array<std::uint8_t, 16> kPyramid{0, 3, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
constexpr std::array<std::uint8_t, 7> kPentaPrismSizes{5, 5, 4, 4, 4, 4, 4};
constexpr std::array<std::uint8_t, 30> kPentaPrism{0, 4, 3, 2, 1, 5, 6, 7, 8, 9, 0, 1, 6, 5, 1,
                                                   2, 7, 6, 2, 3, 8, 7, 3, 4, 9, 8, 4, 0, 5, 9};
constexpr std::array<std::uint8_t, 8> kHexaPrismSizes{6, 6, 4, 4, 4, 4, 4, 4};
constexpr std::array<std::uint8_t, 36> kHexaPrism{0, 5, 4,  3, 2, 1, 6,  7,  8, 9, 10, 11,
                                                  0, 1, 7,  6, 1, 2, 8,  7,  2, 3, 9,  8,
                                                  3, 4, 10, 9, 4, 5, 11, 10, 5, 0, 6,  11};

using Name = std::string_view;
constexpr CellType flat(Name one, Name several, int dimension, std::uint8_t corners,
                        bool brick = false) {
    return {one, several, dimension, corners, false, brick, {}, {}};
}
constexpr CellType solid(Name one, Name several, std::uint8_t corners, bool brick, Bytes sizes,
                         Bytes faces) {
    return {one, several, 3, corners, false, brick, sizes, faces};
}
constexpr CellType curved(CellType of) {
    of.isCurved = true;
    return of;
}

constexpr CellType kVertex = flat("vertex", "vertices", 0, 0), kLine = flat("line", "lines", 1, 2),
                   kPolyLine = flat("polyline", "polylines", 1, 0),
                   kTriangle = flat("triangle", "triangles", 2, 3),
                   kQuad = flat("quadrilateral", "quadrilaterals", 2, 4, true),
                   kPolygon = flat("polygon", "polygons", 2, 0),
                   kFlatPixel{"pixel", "pixels", 2, 4, false, true, kPixelSizes, kPixel},
                   kTet = solid("tetrahedron", "tetrahedra", 4, false, kTetraSizes, kTetra),
                   kBox = solid("voxel", "voxels", 8, true, kBoxSizes, kVoxel),
                   kHex = solid("hexahedron", "hexahedra", 8, true, kBoxSizes, kHexahedron),
                   kPrism = solid("wedge", "wedges", 6, false, kWedgeSizes, kWedge),
                   kPyr = solid("pyramid", "pyramids", 5, false, kPyramidSizes, kPyramid),
                   kPrismOf5 = solid("pentagonal prism", "pentagonal prisms", 10, false,
                                     kPentaPrismSizes, kPentaPrism),
                   kPrismOf6 = solid("hexagonal prism", "hexagonal prisms", 12, true,
                                     kHexaPrismSizes, kHexaPrism),
                   kAnySolid = solid("polyhedron", "polyhedra", 0, false, {}, {});

struct Numbered {
    std::uint8_t number;
    CellType type;
};
constexpr std::array kTypes{
    Numbered{1, kVertex},
    Numbered{2, kVertex},
    Numbered{3, kLine},
    Numbered{4, kPolyLine},
    Numbered{5, kTriangle},
    Numbered{7, kPolygon},
    Numbered{8, kFlatPixel},
    Numbered{9, kQuad},
    Numbered{10, kTet},
    Numbered{11, kBox},
    Numbered{12, kHex},
    Numbered{13, kPrism},
    Numbered{14, kPyr},
    Numbered{15, kPrismOf5},
    Numbered{16, kPrismOf6},
    Numbered{21, curved(kLine)},
    Numbered{22, curved(kTriangle)},
    Numbered{23, curved(kQuad)},
    Numbered{24, curved(kTet)},
    Numbered{25, curved(kHex)},
    Numbered{26, curved(kPrism)},
    Numbered{27, curved(kPyr)},
    Numbered{28, curved(kQuad)},
    Numbered{29, curved(kHex)},
    Numbered{30, curved(kQuad)},
    Numbered{31, curved(kPrism)},
    Numbered{32, curved(kPrism)},
    Numbered{33, curved(kHex)},
    Numbered{34, curved(kTriangle)},
    Numbered{35, curved(kLine)},
    Numbered{37, curved(kPyr)},
    Numbered{kPolyhedron, kAnySolid},
    // Lagrange's and Bezier's.
    Numbered{68, curved(kLine)},
    Numbered{69, curved(kTriangle)},
    Numbered{70, curved(kQuad)},
    Numbered{71, curved(kTet)},
    Numbered{72, curved(kHex)},
    Numbered{73, curved(kPrism)},
    Numbered{74, curved(kPyr)},
    Numbered{75, curved(kLine)},
    Numbered{76, curved(kTriangle)},
    Numbered{77, curved(kQuad)},
    Numbered{78, curved(kTet)},
    Numbered{79, curved(kHex)},
    Numbered{80, curved(kPrism)},
    Numbered{81, curved(kPyr)},
};

constexpr auto kByNumber = [] {
    std::array<std::uint8_t, 256> at{};
    for (std::size_t i = 0; i < kTypes.size(); ++i)
        at[kTypes[i].number] = static_cast<std::uint8_t>(i + 1);
    return at;
}();

}  // namespace

const CellType* cellTypeOf(std::uint8_t number) {
    const std::uint8_t at = kByNumber[number];
    return at == 0 ? nullptr : &kTypes[at - 1].type;
}

std::string cellName(std::uint8_t number, std::uint64_t count) {
    const CellType* type = cellTypeOf(number);
    if (number == kTriangleStrip) return count == 1 ? "triangle strip" : "triangle strips";
    if (number == 0) return fmt::format("{} of unknown shape", count == 1 ? "cell" : "cells");
    if (!type) return fmt::format("{} of type {}", count == 1 ? "cell" : "cells", number);
    return fmt::format("{}{}", type->isCurved ? "curved " : "",
                       count == 1 ? type->one : type->several);
}

}  // namespace timeseries
