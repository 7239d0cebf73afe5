// Numbers in files' names: how a name is cut at them, and which files make one numbered series.
// Names alone; no file is touched.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
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
// Natural order: texts as texts, digits as numbers.
bool nameLess(const std::filesystem::path& a, const std::filesystem::path& b);

// The one number in which two names differ; none when they differ elsewhere, or not at all.
std::optional<std::size_t> onlyDifference(const Name& a, const Name& b);

// In "t_0.25" and "t_0.5" the last digits may be a fraction or a count: their orders differ.
bool ambiguous(const Name& name, std::size_t at, std::span<const std::string> numbers);

// Files of one folder whose names differ in one number, ascending by it.
struct Numbered {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> numbers;  // without leading zeros
};

// REQUIRES: every name has a number `at`.
Numbered byNumber(std::vector<std::filesystem::path> files, std::size_t at);
// None when they are no numbered series.
std::optional<Numbered> numbered(std::span<const std::filesystem::path> paths);

}  // namespace timeseries
