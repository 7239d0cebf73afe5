// Where the values of an array lie: behind its header, or in the files that this names.
#pragma once

#include <filesystem>
#include <vector>

#include "timeseries/readers/arrays/array_header.h"

namespace timeseries {

struct ArrayPieces {
    std::vector<std::filesystem::path> paths;  // each holds as many values, one after the other
    std::uint64_t pieceCount = 0;              // values in each
    std::uint64_t headerBytes = 0;             // before them, of an attached header
};

// Throws FileError, also when a file is missing or cannot hold what is declared.
ArrayPieces piecesOf(const ArrayHeader& header, std::vector<std::string>& notes);

}  // namespace timeseries
