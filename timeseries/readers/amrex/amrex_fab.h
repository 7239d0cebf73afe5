// A FAB of an AMReX plotfile: the values of all variables in a box of cells, behind a line of text,
//   FAB ((8, (64 11 52 0 1 12 0 1023)),(8, (8 7 6 5 4 3 2 1)))((0,0,0) (31,31,31) (0,0,0)) 3
// how a number is made, which of its bytes come in which order (the first is that of the sign), the
// box, how many variables. AMReX, Src/Base: AMReX_FArrayBox, AMReX_FabConv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/grid/index_boxes.h"

namespace timeseries {

// What its line says.
struct AmrexFabHeader {
    ValueType type{};                 // F32 or F64
    std::vector<std::uint8_t> order;  // [bytes of a number]: where in the file each is, from 0
    IndexBox box;
    std::size_t variables = 0;
    std::uint64_t first = 0;  // the byte of the file that values begin at
};

// A file of FABs, which the file itself holds whole.
class AmrexFabFile {
 public:
    // Throws FileError.
    explicit AmrexFabFile(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    // Throws FileError where there is none at the byte, or its values are beyond the file's end.
    AmrexFabHeader headerAt(std::uint64_t offset, std::size_t dimensions);
    // x fastest, so many as the box has cells. REQUIRES: T of the header's type, variable <
    // variables. Throws FileError.
    template <typename T>
    std::vector<T> values(const AmrexFabHeader& header, std::size_t variable);

 private:
    const std::filesystem::path path_;
    std::ifstream file_;
    std::uint64_t bytes_ = 0;
};

}  // namespace timeseries
