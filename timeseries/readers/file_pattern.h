// The files that a pattern with wildcards names, as a shell finds them.
#pragma once

#include <filesystem>
#include <vector>

namespace timeseries {

// Whether that is one: what is there by that very name is not.
bool isPattern(const std::filesystem::path& path);

// Its files and what else is opened as one, of a folder in the order of their names. Throws
// FileError where there is none, or too many (kMaxSeriesFiles), and where some of its folders
// cannot be listed: what is in them would be missing.
std::vector<std::filesystem::path> filesOfPattern(const std::filesystem::path& pattern);

}  // namespace timeseries
