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

#include "timeseries/grid/field.h"

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

// Of a file's beginning: its titles and its first row. Nothing where it is no table with places and
// other numbers.
std::optional<CsvHeader> csvHeaderOf(std::string_view start);
// Why there is none, of a table whose titles name x and y: which number is none.
std::optional<std::string> csvFlawOf(std::string_view start);

// Of a column: doubles, of which what stands for nothing ("", "nan", "NA", "null") is NaN; whole
// numbers of 64 bits where all are whole and some are more than doubles tell apart.
struct CsvNumbers {
    Values values;              // [row]
    std::vector<bool> missing;  // of whole numbers, as Field::missing
};

// [column]: none of text, doubles of places. Throws FileError.
std::vector<CsvNumbers> readCsv(const std::filesystem::path& path, const CsvHeader& header);

}  // namespace timeseries
