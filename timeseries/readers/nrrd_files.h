// Where the values of an NRRD file lie: behind its header, or in the files that the field
// `data file` names: one, a LIST, or a numbered pattern.
#pragma once

#include <filesystem>
#include <vector>

#include "timeseries/readers/nrrd_header.h"

namespace timeseries {

struct NrrdPieces {
    std::vector<std::filesystem::path> paths;  // each holds as many values, one after the other
    std::uint64_t pieceCount = 0;              // values in each
    std::uint64_t headerBytes = 0;             // before them, of an attached header
};

// Throws FileError, also when a file is missing or cannot hold what is declared.
NrrdPieces piecesOf(const NrrdHeader& header, std::vector<std::string>& notes);

}  // namespace timeseries
