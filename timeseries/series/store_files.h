// What of the files in a StepStore's folder is the store's.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <vector>

namespace timeseries {

struct StoredFile {
    std::filesystem::path path;
    std::uint64_t bytes = 0;
    std::chrono::system_clock::time_point used;  // last
};

constexpr const char* kStoredSuffix = ".isostep";
// Such names StepStore::pathOf gives, 32 digits; what else lies in a folder is somebody's own.
bool isStored(const std::filesystem::path& path);
// All files, not links, that have such names, in no order; none where nothing is there.
// Throws StepFileError for what is no folder, or cannot be listed.
std::vector<StoredFile> storedFiles(const std::filesystem::path& folder);
// Whether a store has written it, by what is in it: under such a name a simulation may have written
// a step, or somebody a text. What else is damaged in it does not count.
bool isOfStore(const std::filesystem::path& path);

// Says on the disk when it was used, where that can be written.
void setUse(const StoredFile& file);

// As the system's clock has it.
std::int64_t nanosecondsOf(const timespec& at);
std::chrono::system_clock::time_point timeOf(const timespec& at);

}  // namespace timeseries
