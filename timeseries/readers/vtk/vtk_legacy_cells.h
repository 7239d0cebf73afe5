// The points and cells of a legacy unstructured grid, or of legacy polygons ("VTK File Formats",
// Kitware, "Unstructured grid", "Polygonal data").
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/vtk/vtk_text.h"

namespace timeseries {

class VtkLegacyCells {
 public:
    enum class Kind { Unstructured, Polygons };
    // From version 5 on the ends of the cells' lists stand apart.
    VtkLegacyCells(Kind kind, bool endsApart) : kind_(kind), endsApart_(endsApart) {}

    // Reads the section of that word, in lower case; false: it is none of a grid. Throws FileError.
    bool read(VtkText& text, const std::string& word);
    // The section that is still missing; "" when the grid is whole, to which polygons may be added.
    std::string missing() const;
    // REQUIRES: nothing is missing. Throws FileError when a cell's list is none.
    UnstructuredGrid take(const VtkText& text);

 private:
    void readPoints(VtkText& text);
    // Cells, one's list behind that of the one before.
    struct Lists {
        std::vector<std::uint64_t> ends;
        std::vector<std::uint32_t> numbers;  // points, or a polyhedron's faces
        std::optional<std::int64_t> none;    // the first of them that is no point, if it is known
        bool isThere = false;
    };
    void readCells(VtkText& text, Lists& lists);
    void readTypes(VtkText& text);
    void add(const VtkText& text, const Lists& lists, std::size_t firstType);
    // `none`: what the first one that is no point is.
    void addCorners(std::span<const std::uint32_t> list, const std::optional<std::int64_t>& none);
    // The list of a polyhedron: its faces.
    void addPolyhedron(const VtkText& text, std::span<const std::uint32_t> list);

    Kind kind_;
    bool endsApart_;
    bool hasPoints_ = false, hasTypes_ = false;
    UnstructuredGrid grid_;
    std::array<Lists, 3> lists_;  // of polygons: points, lines and surfaces; else the first
};

}  // namespace timeseries
