// Tables of numbers as text, by libcsv: the columns that a first line names, separated by commas,
// semicolons, tabs or blanks. Lines before it that begin with # are passed over, but for the last,
// where it names the columns itself.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace timeseries {

struct CsvColumn {
    std::string name, units;  // "T [K]" is T in K
    bool isText = false;      // no number stands below
};

struct CsvHeader {
    char separator = ',';
    std::vector<CsvColumn> columns;
    // Which of them are coordinates: x and y, and z where the points do not lie in a plane.
    std::array<std::optional<std::size_t>, 3> places;
};

// Of a file's beginning: its first two lines. Nothing where it is no table with places and other
// numbers.
std::optional<CsvHeader> csvHeaderOf(std::string_view start);

// [column][row], none of text; what stands for nothing ("", "nan", "NA", "null") is NaN. Throws
// FileError.
std::vector<std::vector<double>> readCsv(const std::filesystem::path& path,
                                         const CsvHeader& header);

}  // namespace timeseries
