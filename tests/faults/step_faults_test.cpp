// Sorted steps on a system that fails: the calls by which files are read and written are this
// program's own here, pass on what they are asked to the kernel, and fail when a test says so.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <functional>
#include <map>
#include <optional>
#include <random>

#include "tests/support/files.h"
#include "tests/support/random_field.h"
#include "tests/support/rounds.h"
#include "tests/support/step_bytes.h"
#include "timeseries/readers/reader.h"
#include "timeseries/series/step_maker.h"

namespace {

namespace fs = std::filesystem;

// Given a call's number among those of its kind, and what it asks for: nothing to let it be, or
// what it returns (a count, or -errno). One thread.
using Meddle = std::function<std::optional<long>(std::size_t call, std::size_t bytes)>;
struct Calls {
    Meddle pread, pwrite, fsync, rename, flock;
    std::size_t preads = 0, pwrites = 0, fsyncs = 0, renames = 0, flocks = 0;
    // The process is killed in place of what would be the so-manieth of all that change anything.
    std::optional<std::size_t> killedAt;
    std::size_t changes = 0;
} calls;

void perhapsDie() {
    if (calls.killedAt && calls.changes++ == *calls.killedAt) ::kill(::getpid(), SIGKILL);
}

// What was done to files below a folder, in order, while it is watched.
struct Done {
    enum What { Write, Sync, SyncFolder, Rename, Remove } what;
    std::string path, to;
    std::uint64_t at = 0;
    std::string bytes;
};
std::optional<std::string> watched;
std::vector<Done> done;

std::string pathOf(int file) {
    std::error_code failed;
    return fs::read_symlink("/proc/self/fd/" + std::to_string(file), failed).string();
}

void note(Done what) {
    if (watched && what.path.starts_with(*watched)) done.push_back(std::move(what));
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
ssize_t pwrite(int file, const void* from, size_t bytes, off_t at) {
    perhapsDie();
    if (calls.pwrite)
        if (const auto meddled = calls.pwrite(calls.pwrites++, bytes)) {
            if (*meddled < 0) return answer(*meddled);
            bytes = static_cast<size_t>(*meddled);
        }
    const long put = ::syscall(SYS_pwrite64, file, from, bytes, at);
    if (put > 0)
        note({Done::Write,
              pathOf(file),
              "",
              static_cast<std::uint64_t>(at),
              {static_cast<const char*>(from), static_cast<std::size_t>(put)}});
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

namespace timeseries {
namespace {

using testing::HasSubstr;

class StepFaults : public testing::Test {
 protected:
    ~StepFaults() override {
        calls = {};
        watched.reset();
        done.clear();
    }
    fs::path folder = tests::freshFolder();
    std::mt19937_64 random{11};
    Field field = tests::randomField<float>(random, {60, 50, 40}, 0);
    SortedStep step = SortedStep::build(field);
    fs::path path = folder / "a.isostep";

    void write() const {
        WholeFile file(path);
        writeStep(step, "about", file, {}, 1);
        file.finish();
    }
    void expectWhole(const SortedStep& stored) const {
        EXPECT_TRUE(std::ranges::equal(stored.gridIndex(), step.gridIndex()));
    }
};

TEST_F(StepFaults, ShortAndInterruptedReadsAndWritesChangeNothing) {
    const auto some = [&](std::size_t call, std::size_t bytes) -> std::optional<long> {
        if (call % 3 == 0) return -EINTR;
        return static_cast<long>(std::max<std::size_t>(1, random() % (bytes + 1)));
    };
    calls.pread = calls.pwrite = some;
    write();
    const SortedStep stored = SortedStep::stored(
        std::make_shared<const StepFile>(openBytes(path)), field.grid, false,
        {[](const std::string& why) -> SortedStep { throw std::runtime_error(why); }});
    expectWhole(stored);
    EXPECT_GT(calls.preads, 20u);
    EXPECT_GT(calls.pwrites, 20u);
    calls = {};
    EXPECT_EQ(tests::readBytes(path).size(), tests::written(step, "about").size());
}

// A disk that fails at any one read, and from then on.
TEST_F(StepFaults, AFailedReadIsToldOrTheStepIsMadeAgain) {
    write();
    std::size_t refused = 0, madeAgain = 0;
    for (std::size_t first = 0;; ++first) {
        calls = {};
        calls.pread = [&](std::size_t call, std::size_t) -> std::optional<long> {
            return call >= first ? std::optional<long>(-EIO) : std::nullopt;
        };
        int made = 0;
        try {
            const SortedStep stored =
                SortedStep::stored(std::make_shared<const StepFile>(openBytes(path)), field.grid,
                                   false, {[&](const std::string& why) {
                                       ++made;
                                       EXPECT_THAT(why, HasSubstr("a.isostep: Input/output error"));
                                       return SortedStep::build(field);
                                   }});
            expectWhole(stored);
        } catch (const StepFileError& error) {
            EXPECT_THAT(error.what(), HasSubstr("a.isostep: Input/output error"));
            EXPECT_EQ(made, 0);
            ++refused;
            continue;
        }
        EXPECT_LE(made, 1);
        madeAgain += static_cast<std::size_t>(made);
        if (made == 0) break;  // it fails later than anything is read
    }
    EXPECT_GE(refused, 3u);    // header, directory, summary
    EXPECT_GE(madeAgain, 6u);  // blocks
}

TEST_F(StepFaults, AFailedWriteLeavesTheOldFile) {
    write();
    const std::string before = tests::readBytes(path);
    step = SortedStep::build(tests::randomField<float>(random, {60, 50, 40}, 0));
    std::size_t failed = 0;
    for (std::size_t first = 0;; ++first) {
        calls = {};
        calls.pwrite = [&](std::size_t call, std::size_t) -> std::optional<long> {
            return call >= first ? std::optional<long>(-ENOSPC) : std::nullopt;
        };
        try {
            write();
            break;
        } catch (const StepFileError& error) {
            EXPECT_THAT(error.what(), HasSubstr("a.isostep: No space left on device"));
            ++failed;
        }
        calls = {};
        EXPECT_EQ(tests::readBytes(path), before);
        EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
    }
    EXPECT_GE(failed, 4u);
    EXPECT_NE(tests::readBytes(path), before);
}

// A file system that fails when all is to be on the disk, or where the name cannot be given.
TEST_F(StepFaults, AFailedFlushOrRenameLeavesTheOldFile) {
    write();
    const std::string before = tests::readBytes(path);
    step = SortedStep::build(tests::randomField<float>(random, {60, 50, 40}, 0));
    const auto fails = [](int code) {
        return [code](std::size_t, std::size_t) { return std::optional<long>(-code); };
    };
    const auto refusal = [&] {
        try {
            write();
        } catch (const StepFileError& error) {
            calls = {};
            EXPECT_EQ(tests::readBytes(path), before);
            EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
            return std::string(error.what());
        }
        return std::string("written");
    };
    calls.fsync = fails(EIO);
    EXPECT_THAT(refusal(), HasSubstr("a.isostep: Input/output error"));
    calls.rename = fails(EROFS);
    EXPECT_THAT(refusal(), HasSubstr("a.isostep: Read-only file system"));
    // Only the folder's, behind the rename: the file is there, and whole.
    calls.fsync = [](std::size_t call, std::size_t) {
        return call > 0 ? std::optional<long>(-EIO) : std::nullopt;
    };
    EXPECT_EQ(refusal(), "written");
    EXPECT_NE(tests::readBytes(path), before);
}

// A network's file system that knows none: what is written is whole, and what others left stays.
TEST_F(StepFaults, WithoutLocksAFileIsWrittenAndNothingElseRemoved) {
    const fs::path left = folder / "a.isostep.1-2.unfinished";
    tests::writeBytes(left, "left");
    calls.flock = [](std::size_t, std::size_t) { return std::optional<long>(-ENOLCK); };
    write();
    removeUnfinished(folder, [](const fs::path&) { return true; });
    EXPECT_GT(calls.flocks, 1u);
    calls = {};
    EXPECT_TRUE(fs::exists(left));
    expectWhole(SortedStep::stored(
        std::make_shared<const StepFile>(openBytes(path)), field.grid, false,
        {[](const std::string& why) -> SortedStep { throw std::runtime_error(why); }}));
    removeUnfinished(folder, [](const fs::path&) { return true; });
    EXPECT_FALSE(fs::exists(left));
}

// Killed in place of each of the writer's calls.
TEST_F(StepFaults, AWriterThatIsKilledAtAnyCallLeavesTheOldFileOrTheNew) {
    write();
    const std::string before = tests::readBytes(path);
    step = SortedStep::build(tests::randomField<float>(random, {60, 50, 40}, 0));
    const std::string after = [&] {
        const auto bytes = tests::written(step, "about");
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }();
    ASSERT_NE(before, after);
    std::size_t old = 0;
    for (std::size_t at = 0;; ++at) {
        const pid_t child = ::fork();
        if (child == 0) {
            calls.killedAt = at;
            try {
                write();
            } catch (...) {
                ::_exit(1);
            }
            ::_exit(0);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        const std::string found = tests::readBytes(path);
        ASSERT_TRUE(found == before || found == after) << at;
        old += found == before;
        removeUnfinished(folder, [](const fs::path&) { return true; });
        ASSERT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << at;
        if (WIFEXITED(status)) {
            EXPECT_EQ(WEXITSTATUS(status), 0);
            EXPECT_EQ(found, after);
            break;
        }
    }
    EXPECT_GE(old, 5u);  // pieces, header, sync, rename
}

// What a disk holds after the power went: of each file the pages that were synced, and of those
// that were not some; of names that were not synced the first ones.
class Disk {
 public:
    explicit Disk(std::mt19937_64& random) : random_(random) {}

    void put(const std::string& path, std::string bytes) {
        files_.push_back({bytes, std::move(bytes)});
        names_[path] = files_.size() - 1;
        namesThen_.assign(1, names_);
    }
    void doIt(const Done& what) {
        switch (what.what) {
            case Done::Write: {
                std::string& now = of(what.path).now;
                now.resize(std::max<std::size_t>(now.size(), what.at + what.bytes.size()));
                now.replace(what.at, what.bytes.size(), what.bytes);
                break;
            }
            case Done::Sync:
                of(what.path).synced = of(what.path).now;
                break;
            case Done::SyncFolder:
                namesThen_.assign(1, names_);
                break;
            case Done::Rename:
                names_[what.to] = names_.at(what.path);
                names_.erase(what.path);
                namesThen_.push_back(names_);
                break;
            case Done::Remove:
                names_.erase(what.path);
                namesThen_.push_back(names_);
        }
    }
    // By name.
    std::map<std::string, std::string> afterTheCrash() {
        std::map<std::string, std::string> left;
        for (const auto& [name, file] : namesThen_[random_() % namesThen_.size()])
            left[name] = some(files_[file]);
        return left;
    }

 private:
    struct File {
        std::string now, synced;
    };
    using Names = std::map<std::string, std::size_t>;

    File& of(const std::string& path) {
        if (!names_.contains(path)) {
            files_.emplace_back();
            names_[path] = files_.size() - 1;
            namesThen_.push_back(names_);
        }
        return files_[names_[path]];
    }
    std::string some(const File& file) {
        constexpr std::size_t kPage = 4096;
        std::string bytes = file.synced;
        for (std::size_t at = 0; at < file.now.size(); at += kPage) {
            const std::string page = file.now.substr(at, kPage);
            if (random_() % 2 == 0 ||
                file.synced.compare(at < file.synced.size() ? at : 0, kPage, page) == 0)
                continue;
            bytes.resize(std::max(bytes.size(), at + page.size()));
            bytes.replace(at, page.size(), page);
        }
        return bytes;
    }

    std::mt19937_64& random_;
    std::vector<File> files_;
    Names names_;
    std::vector<Names> namesThen_;  // as they were since the folder was synced, the oldest first
};

TEST_F(StepFaults, WheneverThePowerGoesTheFileIsTheOldOrTheNewOne) {
    write();
    const std::string before = tests::readBytes(path);
    step = SortedStep::build(tests::randomField<float>(random, {60, 50, 40}, 0));
    watched = folder.string();
    write();
    watched.reset();
    const std::string after = tests::readBytes(path);
    ASSERT_NE(before, after);
    ASSERT_GE(done.size(), 6u);  // pieces, header, sync, rename, sync of the folder
    std::size_t old = 0, anew = 0;
    for (std::size_t crash = 0; crash <= done.size(); ++crash)
        for (int i = 0; i < tests::rounds(50); ++i) {
            Disk disk(random);
            disk.put(path.string(), before);
            for (std::size_t d = 0; d < crash; ++d) disk.doIt(done[d]);
            const auto left = disk.afterTheCrash();
            ASSERT_TRUE(left.contains(path.string())) << crash;
            const std::string& found = left.at(path.string());
            ASSERT_TRUE(found == before || found == after) << "after " << crash << " calls";
            old += found == before;
            anew += found == after;
            if (crash == done.size()) {
                ASSERT_EQ(found, after);
            }
        }
    EXPECT_GT(old, 0u);
    EXPECT_GT(anew, 0u);
}

}  // namespace
}  // namespace timeseries
