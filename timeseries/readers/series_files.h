// Which files a user means who names one member of a numbered series, a folder, a pattern or
// several files: by their names alone, but for telling which files of a mixed folder can be read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace timeseries {

struct ExpandedSeries {
    std::vector<std::filesystem::path> files;  // to be opened as one series, in this order
    // Which of them was named, when it was one and the others were found by its name.
    std::optional<std::size_t> here;
    // "3 files a_1.nc to a_9.nc, numbers 1 to 9 every 4"; "" for a file alone.
    std::string recognised;
    std::vector<std::string> notes;  // missing numbers, numbers that stand twice, files passed over
};

// The most files that are listed of a folder or a pattern.
inline constexpr std::size_t kMaxSeriesFiles = 100'000;

// Numbers are whole runs of digits in the name before its extension, or decimal where nothing
// speaks against it (decimal_names.h); leading zeros do not count. A series is of one folder, and
// its names differ in one number only: the last one that varies, where several do each by itself.
// Where it is unclear whether it is decimal, a file named stays alone, and files found together are
// ordered by whole numbers; a note tells. A .pvd lists its files itself and stays alone.
// A path that does not exist, and is no pattern, is returned as it is.
// Throws FileError for a pattern without a match, and for a folder that does not hold one series.
ExpandedSeries expandSeries(std::span<const std::filesystem::path> named);

// The number by which names of one folder differ, where it is one and ascends with the paths.
std::optional<std::vector<double>> ascendingNumbers(std::span<const std::filesystem::path> paths);

// What their names begin with, without what numbers them; "values" where that is nothing.
std::string commonName(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
