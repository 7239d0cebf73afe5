// A file's name cut at its numbers, and the order of such names. Names alone; no file is touched.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace timeseries {

// A file's name cut at its runs of digits: texts[0] digits[0] texts[1] ... texts.back() extension.
// A minus that follows no letter and no digit ("t_-3") belongs to the digits, and what programs
// write as a power of ten ("1.5e-05") is cut as if it stood there in full ("0.000015").
struct Name {
    std::vector<std::string> texts{""}, digits;
    std::string extension;
    std::vector<std::size_t> powers;  // places in digits of what stands before their dots
};

Name cut(const std::filesystem::path& path);

// "a_*_*.nc": the name's texts, whatever its numbers.
std::string shapeOf(const std::filesystem::path& path);

// Of "-007": "-7".
std::string withoutZeros(const std::string& digits);
bool isNegative(const std::string& digits);
// Of any length: simulations number their steps with more digits than an integer has.
bool numberLess(const std::string& a, const std::string& b);
// Natural order: texts as texts, digits as numbers.
bool nameLess(const std::filesystem::path& a, const std::filesystem::path& b);

// The places of the numbers in which two names differ, ascending; none when they differ elsewhere.
std::optional<std::vector<std::size_t>> differences(const Name& a, const Name& b);

}  // namespace timeseries
