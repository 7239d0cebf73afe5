// Which files make one numbered series, by their names alone; no file is touched.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "timeseries/readers/text/cut_name.h"

namespace timeseries {

// Whether the last digits may be a fraction or a count, as in "t_0.25" and "t_0.5": their orders
// differ.
bool ambiguous(const Name& name, std::size_t at, std::span<const std::string> numbers);

// Files of one folder whose names differ in one number, ascending by it.
struct Numbered {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> numbers;  // "41", or decimals, "0.50"; without leading zeros
};

// None when they are no numbered series, and where it is unclear whether numbers are decimal.
std::optional<Numbered> numbered(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
