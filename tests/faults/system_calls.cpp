#include "tests/faults/system_calls.h"

#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <utility>

namespace tests {

Calls calls;
std::optional<std::string> watched;
std::vector<Done> done;

namespace {

namespace fs = std::filesystem;

void perhapsDie() {
    if (calls.killedAt && calls.changes++ == *calls.killedAt) ::kill(::getpid(), SIGKILL);
}

std::string pathOf(int file) {
    std::error_code failed;
    return fs::read_symlink("/proc/self/fd/" + std::to_string(file), failed).string();
}

void note(Done what) {
    if (!watched || !what.path.starts_with(*watched)) return;
    what.when = std::chrono::steady_clock::now();
    done.push_back(std::move(what));
}

long answer(long returned) {
    if (returned >= 0) return returned;
    errno = static_cast<int>(-returned);
    return -1;
}

}  // namespace

extern "C" {

ssize_t pread(int file, void* into, size_t bytes, off_t at) {
    if (calls.pread)
        if (const auto meddled = calls.pread(calls.preads++, bytes)) {
            if (*meddled < 0) return answer(*meddled);
            bytes = static_cast<size_t>(*meddled);
        }
    return ::syscall(SYS_pread64, file, into, bytes, at);
}
ssize_t pwritev(int file, const iovec* pieces, int count, off_t at) {
    std::string all;
    for (int i = 0; i < count; ++i)
        all.append(static_cast<const char*>(pieces[i].iov_base), pieces[i].iov_len);
    perhapsDie();
    if (calls.pwritev)
        if (const auto meddled = calls.pwritev(calls.pwritevs++, all.size())) {
            if (*meddled < 0) return answer(*meddled);
            all.resize(static_cast<size_t>(*meddled));
        }
    const long put = ::syscall(SYS_pwrite64, file, all.data(), all.size(), at);
    if (put <= 0) return put;
    all.resize(static_cast<size_t>(put));
    note({Done::Write, pathOf(file), "", static_cast<std::uint64_t>(at), std::move(all)});
    return put;
}
int fsync(int file) {
    perhapsDie();
    if (calls.fsync)
        if (const auto meddled = calls.fsync(calls.fsyncs++, 0))
            return static_cast<int>(answer(*meddled));
    const std::string path = pathOf(file);
    note({fs::is_directory(path) ? Done::SyncFolder : Done::Sync, path, "", 0, ""});
    return static_cast<int>(::syscall(SYS_fsync, file));
}
int rename(const char* from, const char* to) {
    perhapsDie();
    if (calls.rename)
        if (const auto meddled = calls.rename(calls.renames++, 0))
            return static_cast<int>(answer(*meddled));
    note({Done::Rename, from, to, 0, ""});
    return static_cast<int>(::syscall(SYS_rename, from, to));
}
int unlink(const char* path) {
    perhapsDie();
    note({Done::Remove, path, "", 0, ""});
    return static_cast<int>(::syscall(SYS_unlink, path));
}

// By another name here, which struct flock has too.
int lockFile(int file, int operation) __asm__("flock");
int lockFile(int file, int operation) {
    if (calls.flock)
        if (const auto meddled = calls.flock(calls.flocks++, 0))
            return static_cast<int>(answer(*meddled));
    return static_cast<int>(::syscall(SYS_flock, file, operation));
}

}  // extern "C"

}  // namespace tests
