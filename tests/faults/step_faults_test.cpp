// Sorted steps on a system that fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/faults/disk_without_power.h"
#include "tests/faults/system_calls.h"
#include "tests/support/files.h"
#include "tests/support/random_field.h"
#include "tests/support/rounds.h"
#include "tests/support/step_bytes.h"
#include "tests/support/step_stores.h"
#include "timeseries/readers/reader.h"
#include "timeseries/series/step_maker.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t kPage = 4096;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::calls;
using tests::done;
using tests::watched;

// What writes a step: of its list, or of its field, whose list is found in parts, by buckets or,
// where a value is a byte, by counting.
enum class Writer { OfList, OfField, OfBytes };

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
    Writer writer = Writer::OfList;

    void write() const {
        WholeFile file(path);
        if (writer == Writer::OfList)
            writeStep(step, "about", file, {}, 1);
        else
            writeField(field, "about", file, {}, 1);
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
    calls.pread = calls.pwritev = some;
    write();
    const SortedStep stored = SortedStep::stored(
        std::make_shared<const StepFile>(openBytes(path)), field.grid, false,
        {[](const std::string& why) -> SortedStep { throw std::runtime_error(why); }});
    expectWhole(stored);
    EXPECT_GT(calls.preads, 20u);
    EXPECT_GT(calls.pwritevs, 20u);
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
        calls.pwritev = [&](std::size_t call, std::size_t) -> std::optional<long> {
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

class StepWriters : public StepFaults, public testing::WithParamInterface<Writer> {
 protected:
    StepWriters() { writer = GetParam(); }
    // Another one each time.
    void takeAStep(std::array<std::size_t, 3> size) {
        field = writer == Writer::OfBytes ? tests::randomField<std::uint8_t>(random, size, 0)
                                          : tests::randomField<float>(random, size, 0);
        step = SortedStep::build(field);
    }
    // The same of all writers.
    std::string whole() const {
        const auto bytes = tests::written(step, "about");
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
};
INSTANTIATE_TEST_SUITE_P(By, StepWriters,
                         testing::Values(Writer::OfList, Writer::OfField, Writer::OfBytes));

// Killed in place of each of the writer's calls.
TEST_P(StepWriters, ThatAreKilledAtAnyCallLeaveTheOldFileOrTheNew) {
    takeAStep({60, 50, 40});
    write();
    const std::string before = tests::readBytes(path);
    takeAStep({60, 50, 40});
    const std::string after = whole();
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

// A disk with room for so many bytes takes a page at a time, the last write in part.
void giveRoom(std::uint64_t bytes) {
    calls = {};
    calls.pwritev = [left = bytes](std::size_t, std::size_t asked) mutable -> std::optional<long> {
        if (left == 0) return -ENOSPC;
        const std::uint64_t taken = std::min({left, std::uint64_t{asked}, kPage});
        left -= taken;
        return static_cast<long>(taken);
    };
    // Nothing waits for the disk itself.
    calls.fsync = [](std::size_t, std::size_t) { return std::optional<long>(0); };
}

// Those at which a page is full, and a byte less and more, below all of a file.
std::vector<std::uint64_t> roomsFor(const std::string& file) {
    std::vector<std::uint64_t> rooms{0, 1};
    for (std::uint64_t pages = kPage; pages <= file.size(); pages += kPage)
        rooms.insert(rooms.end(), {pages - 1, pages, pages + 1});
    std::erase_if(rooms, [&](std::uint64_t room) { return room >= file.size(); });
    rooms.push_back(file.size() - 1);
    return rooms;
}

TEST_P(StepWriters, WithoutRoomAtAnyLengthLeaveWhatWasThere) {
    takeAStep({30, 30, 20});
    const std::string file = whole();
    ASSERT_GT(file.size(), 4 * kPage);
    for (const std::uint64_t room : roomsFor(file)) {
        SCOPED_TRACE(testing::Message() << room << " of " << file.size() << " bytes");
        for (const bool isOneThere : {true, false}) {
            if (isOneThere)
                tests::writeBytes(path, "the old one");
            else
                fs::remove(path);
            giveRoom(room);
            EXPECT_THAT([&] { write(); }, ThrowsMessage<StepFileError>(
                                              HasSubstr("a.isostep: No space left on device")));
            EXPECT_EQ(tests::readBytes(path), isOneThere ? "the old one" : "");
            EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), isOneThere ? 1 : 0);
        }
        giveRoom(file.size());
        write();
        EXPECT_TRUE(tests::readBytes(path) == file);
    }
}

class StoresWithoutRoom : public step_stores::StepStores {
 protected:
    ~StoresWithoutRoom() override { calls = {}; }
    // As another program has it.
    void openAnew() {
        store = std::make_shared<StepStore>(folder / "steps", StoreKind::Cache,
                                            StepStore::kNoBudget, step_stores::kAtOnce);
    }
};

using StoresWithoutLocks = StoresWithoutRoom;

TEST_F(StoresWithoutLocks, TellItOnceAndKeepStepsAsEver) {
    calls.flock = [](std::size_t, std::size_t) { return std::optional<long>(-ENOLCK); };
    for (int i = 0; i < 2; ++i) {
        fs::remove(store->pathOf(origin()));
        EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    }
    EXPECT_THAT(store->takeNotes(), ElementsAre(HasSubstr("knows no locks")));
    const auto step = maker()->make(0);
    EXPECT_TRUE(step->file());
    step_stores::expectField(*step, 100);
}

TEST_F(StoresWithoutRoom, AtAnyLengthTellItAndHaveNothing) {
    ASSERT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    const fs::path path = store->pathOf(origin());
    const std::string whole = tests::readBytes(path);
    ASSERT_GT(whole.size(), 2 * kPage);
    for (const std::uint64_t room : roomsFor(whole)) {
        SCOPED_TRACE(testing::Message() << room << " of " << whole.size() << " bytes");
        openAnew();
        fs::remove(path);
        giveRoom(room);
        EXPECT_THAT([&] { (void)maker()->keep(0); },
                    ThrowsMessage<StepFileError>(HasSubstr("No space left on device")));
        EXPECT_EQ(files(), 0u);
        EXPECT_FALSE(store->find(origin()));
        // What was sorted to be shown is shown.
        giveRoom(room);
        const auto one = maker();
        const auto step = one->make(0);
        one->writeOne(StepMaker::Again::Read, [](double) { return true; });
        EXPECT_THAT(store->takeNotes(), ElementsAre(HasSubstr("No space left on device: sorted")));
        EXPECT_FALSE(step->file());
        step_stores::expectField(*step, 100);
        EXPECT_EQ(files(), 0u);
        giveRoom(whole.size());
        EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Written);
        EXPECT_TRUE(tests::readBytes(path) == whole);
        EXPECT_EQ(files(), 1u);
    }
}

TEST_P(StepWriters, WheneverThePowerGoesTheFileIsTheOldOrTheNewOne) {
    takeAStep({60, 50, 40});
    for (const bool isOneThere : {false, true}) {
        if (isOneThere) takeAStep({60, 50, 40});
        const std::string before = tests::readBytes(path);  // "" of none
        done.clear();
        watched = folder.string();
        write();
        watched.reset();
        const std::string after = tests::readBytes(path);
        ASSERT_NE(before, after);
        ASSERT_GE(done.size(), 6u);  // pieces, header, sync, rename, sync of the folder
        std::size_t old = 0, anew = 0;
        for (std::size_t crash = 0; crash <= done.size(); ++crash)
            for (int i = 0; i < tests::rounds(50); ++i) {
                tests::Disk disk(random);
                if (isOneThere) disk.put(path.string(), before);
                for (std::size_t d = 0; d < crash; ++d) disk.doIt(done[d]);
                const auto left = disk.afterTheCrash();
                ASSERT_TRUE(left.contains(path.string()) || !isOneThere) << crash;
                const std::string found =
                    left.contains(path.string()) ? left.at(path.string()) : "";
                ASSERT_TRUE(isOneThere || !left.contains(path.string()) || found == after)
                    << "empty after " << crash << " calls";
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
}

}  // namespace
}  // namespace timeseries
