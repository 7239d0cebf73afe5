#include "timeseries/series/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "timeseries/series/replaced_file.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

// Two of one process have two names.
std::atomic<unsigned> written{0};

[[noreturn]] void fail(const fs::path& path, int code) {
    throw StepFileError(fmt::format("{}: {}", path.string(), std::strerror(code)));
}

using Piece = std::span<const std::byte>;

void writeAll(int file, const fs::path& path, std::uint64_t at, std::span<const Piece> pieces) {
    std::vector<iovec> left;
    for (const Piece piece : pieces)
        left.push_back({const_cast<std::byte*>(piece.data()), piece.size()});
    for (auto next = left.begin(); next != left.end();) {
        const auto atOnce = std::min<std::ptrdiff_t>(left.end() - next, IOV_MAX);
        ssize_t put = ::pwritev(file, &*next, static_cast<int>(atOnce), static_cast<off_t>(at));
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) fail(path, errno);
        at += static_cast<std::uint64_t>(put);
        for (; next != left.end() && static_cast<std::size_t>(put) >= next->iov_len; ++next)
            put -= static_cast<ssize_t>(next->iov_len);
        if (next == left.end()) break;
        next->iov_base = static_cast<std::byte*>(next->iov_base) + put;
        next->iov_len -= static_cast<std::size_t>(put);
    }
}

// "a" of "a.12-3.unfinished"; "" of what a WholeFile is not called.
std::string finishedName(std::string_view name) {
    const auto drop = [&](std::string_view end) {
        if (!name.ends_with(end)) return false;
        name.remove_suffix(end.size());
        return true;
    };
    const auto dropDigits = [&] {
        const std::size_t last = name.find_last_not_of("0123456789");
        const bool any = last != name.npos && last + 1 < name.size();
        if (any) name = name.substr(0, last + 1);
        return any;
    };
    const bool is =
        drop(WholeFile::kSuffix) && dropDigits() && drop("-") && dropDigits() && drop(".");
    return std::string(is ? name : "");
}

}  // namespace

// Between being made and being locked it looks like a leftover, and may be removed.
WholeFile::WholeFile(fs::path path) : path_(std::move(path)) {
    const ReplacedFile there(path_);
    path_ = there.target;
    if (!there.isFile())
        throw StepFileError(
            fmt::format("{}: expected the name of a file, or of none yet", path_.string()));
    if (there.refusal != 0) fail(path_, there.refusal);
    for (;;) {
        unfinished_ = path_;
        unfinished_ += fmt::format(".{}-{}{}", ::getpid(), written++, kSuffix);  // finishedName()
        file_ = ::open(unfinished_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0644);
        if (file_ < 0 && errno == EEXIST) continue;  // of an earlier program of this number
        if (file_ < 0) fail(path_, errno);
        do isLocked_ = ::flock(file_, LOCK_EX) == 0;
        while (!isLocked_ && errno == EINTR);
        struct stat status {};
        if (::fstat(file_, &status) == 0 && status.st_nlink > 0) {
            there.keepMode(file_);
            return;
        }
        ::close(std::exchange(file_, -1));
    }
}

WholeFile::~WholeFile() {
    if (file_ < 0) return;
    ::unlink(unfinished_.c_str());
    ::close(file_);
}

void WholeFile::write(std::uint64_t at, std::span<const std::byte> bytes) {
    writeAll(file_, path_, at, {&bytes, 1});
}

void WholeFile::writePieces(std::uint64_t at, std::span<const Piece> pieces) {
    writeAll(file_, path_, at, pieces);
}

std::uint64_t WholeFile::bytes() const {
    struct stat status {};
    if (::fstat(file_, &status) != 0) fail(path_, errno);
    return static_cast<std::uint64_t>(status.st_size);
}

void WholeFile::finish() {
    if (::fsync(file_) != 0) fail(path_, errno);
    if (::rename(unfinished_.c_str(), path_.c_str()) != 0) fail(path_, errno);
    ::close(std::exchange(file_, -1));
    // The name, too, is to outlive a loss of power; where it does not, the file is made again.
    const fs::path parent = path_.has_parent_path() ? path_.parent_path() : ".";
    const int folder = ::open(parent.c_str(), O_DIRECTORY | O_RDONLY | O_CLOEXEC);
    if (folder < 0) return;
    (void)::fsync(folder);
    ::close(folder);
}

FilePart::FilePart(fs::path path) : path_(std::move(path)) {
    file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0) fail(path_, errno);
}

FilePart::~FilePart() {
    if (file_ >= 0) ::close(file_);
}

void FilePart::write(std::uint64_t at, std::span<const std::byte> bytes) {
    writeAll(file_, path_, at, {&bytes, 1});
}

void FilePart::writePieces(std::uint64_t at, std::span<const Piece> pieces) {
    writeAll(file_, path_, at, pieces);
}

void FilePart::flush() {
    if (::fsync(file_) != 0) fail(path_, errno);
}

void removeUnfinished(const fs::path& folder,
                      const std::function<bool(const fs::path& finished)>& isOurs) {
    std::error_code gone;
    for (const auto& entry : fs::directory_iterator(folder, gone)) {
        const std::string finished = finishedName(entry.path().filename().string());
        if (finished.empty() || !isOurs(finished)) continue;
        const int file = ::open(entry.path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
        if (file < 0) continue;
        if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(entry.path().c_str());
        ::close(file);
    }
}

}  // namespace timeseries
