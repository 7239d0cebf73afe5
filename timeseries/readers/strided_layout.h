// Where what a file stores for the points of a grid lies in one long row of it.
#pragma once

#include <array>
#include <cstddef>

namespace timeseries {

// Point (x, y, z) is at x * stride[0] + y * stride[1] + z * stride[2], in stored numbers or tuples.
struct StridedLayout {
    std::array<std::size_t, 3> size{}, stride{};  // nx, ny, nz
};

// Calls visit(place) for each point of the grid, x fastest.
template <typename Visit>
void forEachPlace(const StridedLayout& layout, Visit visit) {
    const auto& [nx, ny, nz] = layout.size;
    for (std::size_t z = 0; z < nz; ++z)
        for (std::size_t y = 0; y < ny; ++y)
            for (std::size_t x = 0; x < nx; ++x)
                visit(x * layout.stride[0] + y * layout.stride[1] + z * layout.stride[2]);
}

// From the file's order to the grid's.
template <typename T>
T arranged(const T& from, const StridedLayout& layout) {
    T to;
    to.reserve(from.size());
    forEachPlace(layout, [&](std::size_t place) { to.push_back(from[place]); });
    return to;
}

}  // namespace timeseries
