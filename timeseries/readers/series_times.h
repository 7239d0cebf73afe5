// The times of a series of files, of what each of them tells of its own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "timeseries/readers/reader.h"

namespace timeseries {

using TimesOfFiles = std::vector<std::shared_ptr<const TimeAxis>>;  // [file]

struct SeriesTimes {
    std::shared_ptr<const TimeAxis> time;
    std::vector<std::size_t> begins;  // [file]: its first step; and the end
    bool areOwn;                      // the files' own
    std::string note;                 // why they are not, where the files have some
};

// As openSequence() says (sequence_reader.h). Throws FileError, naming two files and the variable,
// where times of files of several steps overlap. REQUIRES: a path for each file, one at least.
SeriesTimes seriesTimes(const std::string& variable, const TimesOfFiles& axes,
                        std::span<const std::filesystem::path> paths);

}  // namespace timeseries
