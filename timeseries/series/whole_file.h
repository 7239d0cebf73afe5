// A file that appears whole under its name, or not at all.
#pragma once

#include <filesystem>
#include <functional>

#include "timeseries/index/byte_source.h"

namespace timeseries {

// Written under another name beside it, which is locked (flock) as long as this lives; what an
// interrupted program leaves is told from what is being written by that. Members throw
// StepFileError; destruction removes what was not finished.
class WholeFile final : public ByteSink {
 public:
    static constexpr const char* kSuffix = ".unfinished";

    explicit WholeFile(std::filesystem::path path);
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;
    ~WholeFile() override;

    void write(std::uint64_t at, std::span<const std::byte> bytes) override;
    void writePieces(std::uint64_t at, std::span<const std::span<const std::byte>> pieces) override;
    // So far.
    std::uint64_t bytes() const;
    // On the disk, and there under its name, in that order.
    void finish();
    // Else the file system knows no locks, and leftovers there are never taken for such.
    bool isLocked() const { return isLocked_; }
    // Where it is until then: for a FilePart of another process.
    const std::filesystem::path& nameOfNow() const { return unfinished_; }

 private:
    std::filesystem::path path_, unfinished_;
    int file_ = -1;
    bool isLocked_ = false;
};

// Written into a WholeFile by another process, while that has it. It knows no lock, which a
// network's file system might take for one against writing. Members throw StepFileError.
class FilePart final : public ByteSink {
 public:
    explicit FilePart(std::filesystem::path path);
    FilePart(const FilePart&) = delete;
    FilePart& operator=(const FilePart&) = delete;
    ~FilePart() override;

    void write(std::uint64_t at, std::span<const std::byte> bytes) override;
    void writePieces(std::uint64_t at, std::span<const std::span<const std::byte>> pieces) override;
    // On the disk.
    void flush();

 private:
    std::filesystem::path path_;
    int file_ = -1;
};

// Removes what programs that were interrupted have left in the folder of such files.
void removeUnfinished(const std::filesystem::path& folder,
                      const std::function<bool(const std::filesystem::path& finished)>& isOurs);

}  // namespace timeseries
