#include "timeseries/series/store_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>

#include "timeseries/index/byte_source.h"
#include "timeseries/index/step_file.h"
#include "timeseries/index/step_header.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::system_clock;

}  // namespace

std::int64_t nanosecondsOf(const timespec& at) {
    return std::int64_t{at.tv_sec} * 1'000'000'000 + at.tv_nsec;
}

Clock::time_point timeOf(const timespec& at) {
    return Clock::time_point(
        std::chrono::duration_cast<Clock::duration>(std::chrono::nanoseconds(nanosecondsOf(at))));
}

void setUse(const StoredFile& file) {
    using std::chrono::nanoseconds;
    const auto since = std::chrono::duration_cast<nanoseconds>(file.used.time_since_epoch());
    const auto seconds = std::chrono::floor<std::chrono::seconds>(since);
    const timespec at{seconds.count(), (since - seconds).count()};
    const std::array both{at, at};
    (void)::utimensat(AT_FDCWD, file.path.c_str(), both.data(), 0);
}

bool isStored(const fs::path& path) {
    const std::string name = path.stem().string();
    return path.extension() == kStoredSuffix && name.size() == 32 &&
           name.find_first_not_of("0123456789abcdef") == name.npos;
}

std::vector<StoredFile> storedFiles(const fs::path& folder) {
    std::vector<StoredFile> files;
    std::error_code failed;
    if (fs::symlink_status(folder, failed).type() == fs::file_type::not_found) return files;
    if (!fs::exists(folder, failed) && !failed)
        throw StepFileError(
            fmt::format("{}: expected a folder, found a link that leads nowhere", folder.string()));
    if (!failed && !fs::is_directory(folder, failed))
        throw StepFileError(fmt::format("{}: expected a folder", folder.string()));
    fs::directory_iterator items(folder, failed);
    if (failed)
        throw StepFileError(fmt::format("{}: what is in it cannot be listed: {}", folder.string(),
                                        failed.message()));
    for (const auto& item : items) {
        if (!isStored(item.path())) continue;
        struct stat status {};
        if (::lstat(item.path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
        files.push_back(
            {item.path(), static_cast<std::uint64_t>(status.st_size), timeOf(status.st_mtim)});
    }
    return files;
}

bool isOfStore(const fs::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
    std::unique_ptr<const ByteSource> bytes;
    try {
        bytes = openBytes(path);
        std::array<char, kStepMagic.size()> magic{};
        if (!bytes || bytes->size() < magic.size()) return false;
        bytes->read(0, std::as_writable_bytes(std::span(magic)));
        if (magic != kStepMagic) return false;
    } catch (const StepFileError&) {
        return false;
    }
    try {
        const auto json = nlohmann::json::parse(StepFile(std::move(bytes)).about(), nullptr, false);
        return json.is_object() && json.contains("files");
    } catch (const DamagedStepError&) {
        return true;
    } catch (const StepFileError&) {
        return false;
    }
}

}  // namespace timeseries
