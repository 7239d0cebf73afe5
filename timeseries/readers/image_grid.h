// The axes of images and rectilinear grids as VTK has them: along those of space, in whichever
// order, or turned and sheared (Kitware, "VTK File Formats", Origin, Spacing, Direction).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "timeseries/grid/grid.h"
#include "timeseries/readers/strided_layout.h"

namespace timeseries {

// Point (i, j, k) lies at origin + direction (spacing * (i, j, k)).
struct ImagePlaces {
    std::array<std::uint64_t, 3> points{};  // along each index
    std::array<std::int64_t, 3> first{};    // the least index
    std::array<double, 3> origin{0, 0, 0}, spacing{1, 1, 1};
    std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};  // row by row
    // Of a rectilinear grid, as many as points; none of an image.
    std::array<std::vector<double>, 3> coordinates = {};
};

struct PlacedImage {
    std::shared_ptr<const Grid> grid;
    StridedLayout layout;  // where the grid's points stand among the image's, i fastest
    std::vector<std::string> notes;
};

// Of its points, or of the middles of its cells. A turned or sheared image keeps the order of its
// axes; their coordinates are those before it is turned.
PlacedImage placedImage(const ImagePlaces& image, bool atCells);

}  // namespace timeseries
