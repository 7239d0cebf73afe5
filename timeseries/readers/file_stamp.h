// What tells a file from another, and from what it was before.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace timeseries {

struct FileStamp {
    std::uint64_t device, number, bytes;
    std::int64_t modified, nanoseconds;
    bool isOfSameFile(const FileStamp& other) const {
        return device == other.device && number == other.number;
    }
    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

// What is said of one that is another than the one which was opened.
inline constexpr const char* kHasChanged = "it has changed since it was opened: open it again";

// None of what is no ordinary file.
inline std::optional<FileStamp> stampOf(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return FileStamp{status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size),
                     status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

}  // namespace timeseries
