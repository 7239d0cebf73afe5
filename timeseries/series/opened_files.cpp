#include "timeseries/series/opened_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

// Some of the first `bytes` of a file, but for where formats count what they hold; "" where it
// cannot be read.
std::string sampleOf(const fs::path& path, std::uint64_t bytes) {
    constexpr std::uint64_t kPieces = 16, kPiece = 256, kCounts = 64;
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return "";
    std::string sample;
    for (std::uint64_t i = 0; i < kPieces && bytes > kCounts; ++i) {
        const std::uint64_t at = kCounts + (bytes - kCounts) / kPieces * i;
        std::string piece(std::min(kPiece, bytes - at), '\0');
        const ssize_t got = ::pread(file, piece.data(), piece.size(), static_cast<off_t>(at));
        sample += piece.substr(0, got > 0 ? static_cast<std::size_t>(got) : 0);
    }
    ::close(file);
    return sample;
}

}  // namespace

OpenedFiles::OpenedFiles(std::span<const fs::path> files) {
    expectSame(files);
    if (files.size() > kFew) return;
    for (auto& [file, first] : files_) first.sample = sampleOf(file, first.bytes);
}

void OpenedFiles::expectSame() {
    std::vector<fs::path> files;
    for (const auto& [file, first] : files_) files.push_back(file);
    expectSame(files);
}

void OpenedFiles::expectSame(std::span<const fs::path> files) {
    for (const fs::path& file : files) {
        const auto now = stampOf(file);
        if (!now) continue;
        const auto [place, isNew] = files_.try_emplace(file);
        First& first = place->second;
        if (isNew) {
            first = {*now, now->bytes, ""};
            continue;
        }
        if (first.seen == *now) continue;
        const bool hasGrown = now->isOfSameFile(first.seen) && now->bytes > first.seen.bytes &&
                              !first.sample.empty() && sampleOf(file, first.bytes) == first.sample;
        if (!hasGrown) throw FileError(fmt::format("{}: {}", file.string(), kHasChanged));
        first.seen = *now;
    }
}

}  // namespace timeseries
