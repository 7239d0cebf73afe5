// Stores whose files are damaged, cannot be written or are written by many at once.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <thread>

#include "tests/support/rounds.h"
#include "tests/support/step_stores.h"
#include "timeseries/series/replaced_file.h"
#include "timeseries/series/whole_file.h"

namespace timeseries {
namespace {

using namespace step_stores;
using step_stores::StepStores;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class KilledWriters : public StepStores {
 protected:
    // Whether a process began a file there and did not finish it.
    bool leftOne(pid_t process) const {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder / "steps", none))
            if (entry.path().filename().string().find(fmt::format(".{}-", process)) !=
                std::string::npos)
                return true;
        return false;
    }
};

TEST_F(StepStores, WhatIsDamagedIsRemovedToldAndSortedAnew) {
    (void)maker()->keep(0);
    const fs::path path = store->pathOf(origin());
    std::string bytes = tests::readBytes(path);
    bytes[100] ^= 1;  // of the header
    tests::writeBytes(path, bytes);
    expectField(*maker()->make(0), 100);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_THAT(store->takeNotes(), ElementsAre(HasSubstr("damaged")));
    // Found out later: by then it is shown.
    (void)maker()->keep(0);
    bytes = tests::readBytes(path);
    bytes[5000] ^= 1;
    tests::writeBytes(path, bytes);
    const auto step = maker()->make(0);
    ASSERT_TRUE(step->file());
    expectField(*step, 100);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_THAT(store->takeNotes(), ElementsAre(HasSubstr("block 0")));
}

// Which may be of use to the program that wrote it, as in a folder that is shared.
TEST_F(StepStores, WhatAnotherVersionWroteStaysUntilItIsWrittenOver) {
    (void)maker()->keep(0);
    const fs::path path = store->pathOf(origin());
    const std::string whole = tests::readBytes(path);
    std::string bytes = whole;
    bytes[8] = 2;  // the version
    tests::writeBytes(path, bytes);
    for (int i = 0; i < 2; ++i) expectField(*maker()->make(0), 100);
    EXPECT_TRUE(tests::readBytes(path) == bytes);
    EXPECT_THAT(store->takeNotes(), ElementsAre(HasSubstr("another version of the program")));
    EXPECT_EQ(store->list().size(), 1u) << "may be cleared";
    EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    EXPECT_TRUE(tests::readBytes(path) == whole);
}

// Blocks of before are never joined with what the source is by now.
TEST_F(StepStores, WhatIsDamagedWhileItsSourceChangedIsToldInsteadOfShown) {
    (void)maker()->keep(0);
    const fs::path path = store->pathOf(origin());
    const auto step = maker()->make(0);
    std::string bytes = tests::readBytes(path);
    bytes[5000] ^= 1;
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << bytes;  // in place
    nrrdOf(file, 50);
    EXPECT_THAT([&] { (void)step->columns(); },
                testing::ThrowsMessage<FileError>(HasSubstr("it has changed since")));
}

TEST_F(StepStores, AFolderThatCannotBeIsToldOnceAndTheProgramGoesOn) {
    tests::writeBytes(folder / "steps", "a file");
    // The other is there, and nobody makes a file in it.
    for (const fs::path& where : {folder / "steps", fs::path("/proc/self")}) {
        const auto in =
            std::make_shared<StepStore>(where, StoreKind::Cache, StepStore::kNoBudget, kAtOnce);
        const auto one = maker(in);
        const auto step = one->make(0);
        one->writeOne(StepMaker::Again::Read, [](double) { return true; });
        EXPECT_THAT(in->takeNotes(), ElementsAre(HasSubstr("not kept")));
        const auto again = one->make(0);
        EXPECT_FALSE(one->hasUnwritten());
        expectField(*again, 100);
    }
}

TEST_F(StepStores, AFolderThatCannotBeListedIsNotEmpty) {
    (void)maker()->keep(0);
    const fs::path steps = folder / "steps";
    if (::geteuid() != 0) {  // who may read anything
        fs::permissions(steps, fs::perms::owner_write | fs::perms::owner_exec);
        const auto cannot = testing::ThrowsMessage<StepFileError>(HasSubstr("cannot be listed"));
        EXPECT_THAT([&] { (void)store->list(); }, cannot);
        EXPECT_THAT([&] { (void)store->clear(); }, cannot);
        EXPECT_TRUE(store->isEmpty());
        fs::permissions(steps, fs::perms::owner_all);
    }
    EXPECT_FALSE(store->isEmpty());
    EXPECT_GT(store->clear(), 0u);
    fs::remove(steps);
    EXPECT_EQ(store->list().size(), 0u);
    fs::create_symlink(folder / "nowhere", steps);
    EXPECT_THAT([&] { (void)store->list(); },
                testing::ThrowsMessage<StepFileError>(HasSubstr("leads nowhere")));
    fs::remove(steps);
    tests::writeBytes(steps, "a file");
    EXPECT_THAT([&] { (void)store->clear(); },
                testing::ThrowsMessage<StepFileError>(HasSubstr("expected a folder")));
    EXPECT_TRUE(store->isEmpty());
}

TEST_F(StepStores, AFullDiskLeavesNothing) {
    // RLIMIT_FSIZE fails a write as a full disk does, at every length.
    (void)maker()->keep(0);
    const auto whole = fs::file_size(store->pathOf(origin()));
    for (const std::uintmax_t most : {std::uintmax_t{1}, whole / 3, whole / 2, whole - 1}) {
        nrrdOf(file, 100);  // written anew: what is kept is of before
        const pid_t child = ::fork();
        if (child == 0) {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit limit{most, most};
            ::setrlimit(RLIMIT_FSIZE, &limit);
            try {
                (void)maker()->keep(0);
                ::_exit(1);
            } catch (const StepFileError&) {
                ::_exit(0);
            }
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(status, 0) << most;
        EXPECT_EQ(files(), 1u);  // the one before
        EXPECT_FALSE(store->find(origin()));
    }
}

// Killed at any moment, a writer leaves the old file or the new one, and what it left is removed by
// the next.
TEST_F(KilledWriters, LeaveTheOldOrTheNew) {
    std::mt19937_64 random(1);
    using Clock = std::chrono::steady_clock;
    // The first few come to their ends: moments are drawn from twice as long as the soonest took.
    constexpr int kWhole = 3;
    Clock::duration lasts = Clock::duration::max();
    int finished = 0, early = 0, within = 0;
    for (int i = 0; i < tests::rounds(500); ++i) {
        const int m = 20 + i;
        nrrdOf(file, m);
        const auto begin = Clock::now();
        const pid_t child = ::fork();
        if (child == 0) {
            (void)maker()->keep(0);
            ::_exit(0);
        }
        int status = 0;
        if (i >= kWhole) {
            std::this_thread::sleep_for(lasts * static_cast<double>(random() % 1000) / 500);
            ::kill(child, SIGKILL);
        }
        ::waitpid(child, &status, 0);
        if (i < kWhole)
            lasts = std::min(lasts, Clock::now() - begin);
        else
            (WIFEXITED(status) ? finished : leftOne(child) ? within : early) += 1;
        expectField(*maker()->make(0), m);
        EXPECT_THAT(store->takeNotes(), Each(HasSubstr("it has changed since it was sorted")));
    }
    EXPECT_GT(finished, 0);
    EXPECT_GT(within, 0) << "while it wrote; " << early << " before or between";
    const auto next = std::make_shared<StepStore>(folder / "steps", StoreKind::Cache,
                                                  StepStore::kNoBudget, kAtOnce);
    nrrdOf(file, 10);
    (void)maker(next)->keep(0);
    EXPECT_EQ(files(), 1u);
}

TEST_F(StepStores, ManyWritersAndReadersOfOneStepAllHaveIt) {
    std::vector<std::jthread> users;
    for (int k = 0; k < 4; ++k)
        users.emplace_back([&] {
            for (int i = 0; i < 20; ++i) {
                if (i % 5 == 4) store->clear();
                const auto one = maker();
                (void)one->keep(0);
                expectField(*one->make(0), 100);
            }
        });
    users.clear();
    EXPECT_THAT(store->takeNotes(), IsEmpty());
    EXPECT_LE(files(), 1u);
}

TEST(WholeFile, TakesTheNameOfAFileThatIsRemovedMeanwhile) {
    const fs::path path = tests::freshFolder() / "a";
    std::jthread others([&](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            tests::writeBytes(path, "");
            fs::remove(path);
        }
    });
    for (int i = 0; i < 20'000; ++i) ASSERT_EQ(ReplacedFile(path).refusal, 0) << i;
}

TEST(WholeFile, LeavesNothingUnlessItIsFinished) {
    const fs::path folder = tests::freshFolder();
    const auto isOurs = [](const fs::path& name) { return name == "a" || name == "b"; };
    {
        WholeFile file(folder / "a");
        file.write(5, std::as_bytes(std::span("abc", 3)));
        removeUnfinished(folder, isOurs);  // it is being written
        EXPECT_FALSE(fs::exists(folder / "a"));
    }
    EXPECT_TRUE(fs::is_empty(folder));
    WholeFile file(folder / "a");
    file.write(2, std::as_bytes(std::span("abc", 3)));
    file.finish();
    EXPECT_EQ(tests::readBytes(folder / "a"), std::string("\0\0abc", 5));
    tests::writeBytes(folder / (std::string("b.1-1") + WholeFile::kSuffix), "left");
    removeUnfinished(folder, isOurs);
    EXPECT_THAT(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
    // What else ends so is somebody's own.
    for (const char* name : {"c.1-1", "b", "b.1", "b.1-", "b.x-1", "thesis", ""})
        tests::writeBytes(folder / (std::string(name) + WholeFile::kSuffix), "kept");
    removeUnfinished(folder, isOurs);
    EXPECT_THAT(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 8);
}

}  // namespace
}  // namespace timeseries
