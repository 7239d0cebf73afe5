// A file's name cut at its numbers, and the order of such names. Names alone; no file is touched.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace timeseries {

// A file's name cut at its runs of digits: texts[0] digits[0] texts[1] ... texts.back() extension.
struct Name {
    std::vector<std::string> texts{""}, digits;
    std::string extension;
};

Name cut(const std::filesystem::path& path);

// "a_*_*.nc": the name's texts, whatever its numbers.
std::string shapeOf(const std::filesystem::path& path);

std::string withoutZeros(const std::string& digits);
// Of any length: simulations number their steps with more digits than an integer has.
bool numberLess(const std::string& a, const std::string& b);
// Natural order: texts as texts, digits as numbers.
bool nameLess(const std::filesystem::path& a, const std::filesystem::path& b);

// The places of the numbers in which two names differ, ascending; none when they differ elsewhere.
std::optional<std::vector<std::size_t>> differences(const Name& a, const Name& b);

}  // namespace timeseries
