// Which axis of an array is time, where its points lie, and where they stand in the file.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/grid/grid.h"
#include "timeseries/readers/arrays/array_header.h"

namespace timeseries {

// Positions in ArrayHeader::axes.
struct ArrayRoles {
    std::optional<std::size_t> time;
    std::vector<std::size_t> space;  // at most 3, fastest first
};

// Throws FileError when points are no scalars, or there are more axes than can be told apart.
ArrayRoles rolesOf(const ArrayHeader& header, std::vector<std::string>& notes);

// Where the points of a step lie in the file: value number ((outer * steps) + step) * inner + i
// holds point (outer * inner + i) of the step, counted along the space axes of the file.
struct ArrayLayout {
    std::uint64_t inner = 1, steps = 1, outer = 1;
    std::array<std::uint64_t, 3> size{1, 1, 1};  // along the space axes of the file, fastest first
    std::array<std::uint64_t, 3> stride{1, 1, 1};  // of each in a Field
    bool turned = false;                           // the strides differ from the file's order
};

// But for the strides. Throws FileError when there are more points or steps than can be read.
ArrayLayout layoutOf(const ArrayHeader& header, const ArrayRoles& roles);

struct ArrayPlacing {
    std::array<Axis, 3> axes;
    CoordinateFrame frame;
    ArrayLayout layout;
};

// By space directions, else by spacings and minimums, else counted. Directions along the
// coordinates of space give axes in the order of these; others keep the file's order, and their
// coordinates are lengths from the first sample.
// Throws FileError.
ArrayPlacing placingOf(const ArrayHeader& header, const ArrayRoles& roles, ArrayLayout layout,
                       std::vector<std::string>& notes);

}  // namespace timeseries
