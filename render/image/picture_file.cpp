#include "render/image/picture_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "render/image/image.h"
#include "timeseries/readers/text/words.h"
#include "timeseries/series/replaced_file.h"

namespace render {

namespace {

std::string lastError() { return std::generic_category().message(errno); }

// What is being written, for a signal's handler, which may do little but read it: in memory that
// stays, and more at once than a program writes.
struct InWork {
    std::atomic<const PartialFile*> by = nullptr;
    std::array<char, PATH_MAX> name{};
};
std::array<InWork, 16> inWork;

void removeInWork(int signal) {
    // Whatever another thread does to a name meanwhile: nothing else is ever removed.
    for (const InWork& each : inWork)
        if (each.by && std::strstr(each.name.data(), PartialFile::kSuffix))
            ::unlink(each.name.data());
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

bool lockAlone(int file) { return ::flock(file, LOCK_EX | LOCK_NB) == 0; }

bool endsIn(const std::filesystem::path& file, std::string_view ending) {
    return timeseries::lower(file.extension().string()) == ending;
}

}  // namespace

bool isPng(const std::filesystem::path& file) { return endsIn(file, ".png"); }
bool isExr(const std::filesystem::path& file) { return endsIn(file, ".exr"); }

PartialFile::PartialFile(std::filesystem::path destination) : destination_(std::move(destination)) {
    const timeseries::ReplacedFile there(destination_);
    target_ = there.target;
    if (!there.isFile() && !there.isFolder()) {  // a device or a pipe is written into
        stream_.reset(std::fopen(target_.c_str(), "wbe"));
        if (!stream_) throw ImageError(destination_, "cannot be written: " + lastError());
        return;
    }
    errno = there.refusal;
    if (errno != 0) throw ImageError(destination_, "cannot be written: " + lastError());
    const int descriptor = openPartial();
    if (descriptor < 0) throw ImageError(destination_, "cannot be created: " + lastError());
    keepInMind();
    there.keepMode(descriptor);
    locked_ = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    stream_.reset(::fdopen(descriptor, "wb"));
    if (stream_) return;
    const std::string why = lastError();
    ::close(descriptor);
    ::close(locked_);
    ::unlink(partial_.c_str());
    forget();
    throw ImageError(destination_, "cannot be written: " + why);
}

// Two programs that write the same picture never share one: each has a lock on its own. One without
// is what a program has left that was ended.
int PartialFile::openPartial() {
    constexpr int kAttempts = 100;
    const auto isNamed = [&](int file) {
        struct stat made {
        }, named{};
        return ::fstat(file, &made) == 0 && ::stat(partial_.c_str(), &named) == 0 &&
               made.st_ino == named.st_ino;
    };
    for (int n = 0; n < kAttempts; ++n) {
        partial_ = target_;
        partial_ += kSuffix + std::to_string(n);
        removeLeft(partial_);
        const int file = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0 && errno != EEXIST) break;
        if (file < 0) continue;
        // Where the file system knows no locks, nothing is taken for a leftover.
        (void)lockAlone(file);
        if (isNamed(file)) return file;
        ::close(file);  // taken for a leftover before it had its lock
    }
    partial_.clear();
    return -1;
}

void PartialFile::removeLeft(const std::filesystem::path& partial) {
    const int left = ::open(partial.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
    if (left < 0) return;
    if (lockAlone(left)) ::unlink(partial.c_str());
    ::close(left);
}

std::filesystem::path PartialFile::destinationOf(const std::filesystem::path& partial) {
    const std::string ending = partial.extension().string();
    const std::string_view suffix = kSuffix;
    const bool isOne = ending.starts_with(suffix) && ending.size() > suffix.size() &&
                       ending.find_first_not_of("0123456789", suffix.size()) == std::string::npos;
    return isOne ? std::filesystem::path(partial).replace_extension() : std::filesystem::path();
}

void PartialFile::keepInMind() {
    if (partial_.native().size() >= PATH_MAX) return;
    for (InWork& each : inWork) {
        const PartialFile* none = nullptr;
        if (!each.by.compare_exchange_strong(none, this)) continue;
        std::strcpy(each.name.data(), partial_.c_str());
        return;
    }
}
void PartialFile::forget() {
    for (InWork& each : inWork) {
        if (each.by != this) continue;
        each.name[0] = 0;
        each.by = nullptr;
    }
}

void PartialFile::leaveNoneWhenEnded() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        // What is ignored, as by nohup, ends nothing.
        if (before.sa_handler == SIG_DFL) std::signal(signal, removeInWork);
    }
}

PartialFile::~PartialFile() {
    forget();
    if (!partial_.empty()) ::unlink(partial_.c_str());
    if (locked_ >= 0) ::close(locked_);
}

void PartialFile::commit() {
    // A full disk may show only when the last buffer is written, so fclose is checked too.
    errno = 0;
    const bool hadError = std::ferror(stream_.get()) != 0;
    if (std::fclose(stream_.release()) != 0 || hadError) {
        throw ImageError(destination_, "cannot be written: " + lastError());
    }
    if (partial_.empty()) return;
    if (::rename(partial_.c_str(), target_.c_str()) != 0) {
        throw ImageError(destination_, "cannot be replaced: " + lastError());
    }
    forget();
    partial_.clear();
}

std::vector<std::byte> readPictureFile(const std::filesystem::path& file) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);  // fails for a folder
    if (error) throw ImageError(file, "cannot be read: " + error.message());
    std::ifstream in(file, std::ios::binary);
    std::vector<std::byte> bytes(size);
    if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
        throw ImageError(file, "cannot be read");
    }
    return bytes;
}

}  // namespace render
