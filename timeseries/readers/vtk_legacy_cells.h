// The points and cells of a legacy unstructured grid ("VTK File Formats", Kitware, "Unstructured
// grid").
#pragma once

#include <string>
#include <vector>

#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/vtk_text.h"

namespace timeseries {

class VtkLegacyCells {
 public:
    // From version 5 on the ends of the cells' lists stand apart.
    explicit VtkLegacyCells(bool endsApart) : endsApart_(endsApart) {}

    // Reads the section of that word, in lower case; false: it is none of a grid. Throws FileError.
    bool read(VtkText& text, const std::string& word);
    // The section that is still missing; "" when the grid is whole.
    std::string missing() const;
    // REQUIRES: nothing is missing. Throws FileError when a cell's list is none.
    UnstructuredGrid take(const VtkText& text);

 private:
    void readPoints(VtkText& text);
    void readCells(VtkText& text);
    void readTypes(VtkText& text);
    // The list of a polyhedron: its faces.
    void addPolyhedron(const VtkText& text, std::size_t first, std::size_t last);

    bool endsApart_;
    bool hasPoints_ = false, hasCells_ = false, hasTypes_ = false;
    UnstructuredGrid grid_;
    std::vector<std::uint64_t> ends_;   // of the cells' lists
    std::vector<std::uint32_t> lists_;  // points, or a polyhedron's faces
};

}  // namespace timeseries
