#include "timeseries/index/byte_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace timeseries {
namespace {

class FileBytes final : public ByteSource {
 public:
    // Takes the file, which is open.
    FileBytes(const std::filesystem::path& path, int file) : path_(path), file_(file) {
        struct stat status {};
        const int failed = ::fstat(file_, &status) == 0 ? 0 : errno;
        if (failed == 0 && S_ISREG(status.st_mode)) {
            size_ = static_cast<std::uint64_t>(status.st_size);
            return;
        }
        ::close(file_);
        if (failed != 0) fail(failed);
        throw DamagedStepError(fmt::format("{}: expected an ordinary file", path.string()));
    }
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;
    ~FileBytes() override { ::close(file_); }

    std::string name() const override { return path_.string(); }
    std::uint64_t size() const override { return size_; }

    void read(std::uint64_t at, std::span<std::byte> into) const override {
        while (!into.empty()) {
            const ssize_t got = ::pread(file_, into.data(), into.size(), static_cast<off_t>(at));
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) fail(errno);
            if (got == 0)
                throw DamagedStepError(
                    fmt::format("{}: it ends at byte {}, within what it lists", name(), at));
            into = into.subspan(static_cast<std::size_t>(got));
            at += static_cast<std::uint64_t>(got);
        }
    }

    void willNeed(std::uint64_t at, std::uint64_t bytes) const override {
        (void)::posix_fadvise(file_, static_cast<off_t>(at), static_cast<off_t>(bytes),
                              POSIX_FADV_WILLNEED);
    }

 private:
    [[noreturn]] void fail(int code) const {
        throw StepFileError(fmt::format("{}: {}", path_.string(), std::strerror(code)));
    }

    std::filesystem::path path_;
    int file_;
    std::uint64_t size_ = 0;
};

}  // namespace

std::unique_ptr<const ByteSource> openBytes(const std::filesystem::path& path) {
    // A pipe that nobody writes to would be waited for.
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file >= 0) return std::make_unique<const FileBytes>(path, file);
    if (errno == ENOENT || errno == ENOTDIR) return nullptr;
    throw StepFileError(fmt::format("{}: {}", path.string(), std::strerror(errno)));
}

}  // namespace timeseries
