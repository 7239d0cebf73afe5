// The shapes of an unstructured grid's cells, numbered as VTK's files number them ("VTK File
// Formats", Kitware, "Cell types").
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace timeseries {

// What a cell is between its corners, which come first among its points.
struct CellType {
    std::string_view one, several;  // its name: "hexahedron", "hexahedra"
    int dimension;                  // 0 to 3
    std::uint8_t corners;           // 0: as many as points
    bool isCurved;                  // it has points between its corners
    bool isBrick;                   // cells of this kind tile space as a lattice does
    // How many corners each face has, and which these are, round it; a surface is one face, and
    // none stands for its corners in their order.
    std::span<const std::uint8_t> faceSizes, faces;
};

constexpr std::uint8_t kPixelCell = 8, kVoxelCell = 11, kWedgeCell = 13, kPolyhedron = 42,
                       kTriangleStrip = 6;  // which is none that takes space
// Null for a number that stands for no shape; of a polyhedron faces stand in the file.
const CellType* cellTypeOf(std::uint8_t number);
// "hexahedra", "curved hexahedron", "cells of type 200": of so many.
std::string cellName(std::uint8_t number, std::uint64_t count);

}  // namespace timeseries
