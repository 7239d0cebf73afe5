// How a PLOT3D file lies, which says nothing of itself but its lengths: Walatka and others, "PLOT3D
// User's Manual", NASA TM 101067, chapter 8. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace timeseries {

struct Plot3dLayout {
    enum class Kind { Places, Flow };  // x, y, z; density, momentum, energy
    Kind kind{};
    bool swapped = false;     // of the other byte order than this machine's
    bool hasBlanks = false;   // behind the places an integer a point: 0 where there is none
    std::uint64_t real = 4;   // bytes of a number
    std::uint64_t first = 0;  // the byte where those of the first grid begin
    std::uint64_t time = 0;   // of a flow: the byte of the number that is its first grid's time
    std::vector<std::array<std::size_t, 3>> grids;

    std::uint64_t points() const {
        return std::uint64_t{1} * grids[0][0] * grids[0][1] * grids[0][2];
    }
};

// Of a binary file of three-dimensional grids, whole, with or without the marks of Fortran's
// records: that which leaves fewest bytes over. Nothing: it is none.
std::optional<Plot3dLayout> plot3dLayoutOf(std::string_view start, std::uint64_t bytes);

}  // namespace timeseries
