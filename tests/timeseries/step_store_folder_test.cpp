// The folder of a store: what it keeps, whose files it takes for its own, and one that moves with
// the data.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/support/step_stores.h"
#include "timeseries/series/step_store.h"
#include "timeseries/series/whole_file.h"

namespace timeseries {
namespace {

using namespace step_stores;
using step_stores::StepStores;

TEST_F(StepStores, TheBudgetKeepsWhatWasUsedLast) {
    (void)maker()->keep(0);
    const std::uint64_t size = store->list().at(0).bytes;
    const auto small =
        std::make_shared<StepStore>(folder / "steps", StoreKind::Cache, size * 5 / 2, kAtOnce);
    const fs::path first = file;
    for (const char* name : {"b.nrrd", "c.nrrd"}) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        EXPECT_TRUE(small->find(originOf(first)));  // used
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        file = nrrdOf(folder / name, 100);
        EXPECT_EQ(maker(small)->keep(0), StepMaker::Kept::Written);
    }
    EXPECT_EQ(files(), 2u);
    EXPECT_TRUE(small->find(originOf(first)));
    EXPECT_FALSE(small->find(originOf(folder / "b.nrrd")));
    EXPECT_TRUE(small->find(originOf(folder / "c.nrrd")));
}

// A simulation's own steps may lie where a cache was put.
TEST_F(StepStores, FilesUnderNamesOfTheirOwnStay) {
    (void)maker()->keep(0);
    const fs::path kept = store->list().at(0).path;
    const std::uint64_t size = store->list().at(0).bytes;
    const std::string own[] = {"wave_0000.isostep", kept.stem().string().substr(1) + ".isostep",
                               kept.stem().string() + "0.isostep",
                               "g" + kept.stem().string().substr(1) + ".isostep"};
    for (const std::string& name : own) fs::copy_file(kept, folder / "steps" / name);
    ASSERT_EQ(files(), 1 + std::size(own));
    EXPECT_EQ(store->list().size(), 1u);
    // Nor do they make room, or take of the budget.
    const auto small =
        std::make_shared<StepStore>(folder / "steps", StoreKind::Cache, size * 3 / 2, kAtOnce);
    file = nrrdOf(folder / "b.nrrd", 100);
    EXPECT_EQ(maker(small)->keep(0), StepMaker::Kept::Written);
    EXPECT_FALSE(fs::exists(kept));
    EXPECT_EQ(files(), 1 + std::size(own));
    const std::uint64_t left = store->list().at(0).bytes;
    EXPECT_EQ(left, store->clear());
    EXPECT_EQ(files(), std::size(own));
    for (const std::string& name : own) EXPECT_TRUE(fs::exists(folder / "steps" / name)) << name;
}

TEST_F(StepStores, WhatNoStoreHasWrittenStaysUnderAnyName) {
    (void)maker()->keep(0);
    const fs::path kept = store->list().at(0).path;
    const auto named = [&](char digit) {
        return folder / "steps" / (std::string(32, digit) + ".isostep");
    };
    tests::writeBytes(named('0'), "my notes");
    fs::create_symlink(kept, named('1'));
    fs::create_symlink(folder / "nowhere", named('2'));
    // By a simulation.
    {
        const auto step = maker()->make(0);
        WholeFile alone(named('3'));
        writeStep(*step, R"({"alone": {"variable": "v"}})", alone);
        alone.finish();
    }
    tests::writeBytes(named('4'), "");
    // Of those that the program has written a damaged one is still its own.
    std::string bytes = tests::readBytes(kept);
    bytes[100] ^= 1;
    tests::writeBytes(named('5'), bytes);
    EXPECT_EQ(store->list().size(), 2u);
    // For a budget that has room for one of all.
    const std::uint64_t size = fs::file_size(kept);
    for (char digit = '0'; digit <= '5'; ++digit)
        if (!fs::is_symlink(named(digit)))
            fs::last_write_time(named(digit),
                                fs::file_time_type::clock::now() - std::chrono::hours(1));
    const auto small =
        std::make_shared<StepStore>(folder / "steps", StoreKind::Cache, size * 3 / 2, kAtOnce);
    file = nrrdOf(folder / "b.nrrd", 100);
    EXPECT_EQ(maker(small)->keep(0), StepMaker::Kept::Written);
    EXPECT_EQ(store->list().size(), 1u);
    EXPECT_FALSE(fs::exists(kept));
    EXPECT_FALSE(fs::exists(named('5')));
    EXPECT_GT(store->clear(), 0u);
    EXPECT_EQ(files(), 5u);
    for (char digit = '0'; digit <= '4'; ++digit)
        EXPECT_TRUE(fs::exists(fs::symlink_status(named(digit)))) << digit;
}

TEST_F(StepStores, BesideTheDataTheyMoveWithThem) {
    const auto beside = [&] {
        return std::make_shared<StepStore>(file.parent_path() / "isochron-index", StoreKind::Beside,
                                           StepStore::kNoBudget, kAtOnce);
    };
    EXPECT_EQ(maker(beside())->keep(0), StepMaker::Kept::Written);
    fs::create_directory(folder / "moved");
    fs::copy(folder / "isochron-index", folder / "moved/isochron-index");
    const auto time = fs::last_write_time(file);
    fs::copy_file(file, folder / "moved/field.nrrd");
    file = folder / "moved/field.nrrd";
    EXPECT_FALSE(maker(beside())->make(0)->file());
    fs::last_write_time(file, time);  // as cp -p and rsync -t leave it
    EXPECT_TRUE(maker(beside())->make(0)->file());
}

// Runs in folders of their own, times of an OpenFOAM case: alike in name, size and time.
TEST_F(StepStores, BesideTheDataFilesOfOneNameInSeveralFoldersAreSeveral) {
    for (const char* run : {"runs/1", "runs/2", "runs/2/0.1"}) fs::create_directories(folder / run);
    const fs::path runs = folder / "runs";
    const std::vector<fs::path> paths{
        nrrdOf(runs / "1/out.nrrd", 100), nrrdOf(runs / "2/out.nrrd", 50),
        nrrdOf(runs / "2/0.1/out.nrrd", 70), nrrdOf(runs / "out.nrrd", 30)};
    const int values[] = {100, 50, 70, 30};
    const auto time = fs::last_write_time(paths[0]);
    for (const fs::path& path : paths) fs::last_write_time(path, time);
    const auto expectEach = [&](const fs::path& at, StepMaker::Kept kept) {
        const auto beside = std::make_shared<StepStore>(
            at / "runs/1/isochron-index", StoreKind::Beside, StepStore::kNoBudget, kAtOnce);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            file = at / fs::relative(paths[i], folder);
            EXPECT_EQ(maker(beside)->keep(0), kept) << file;
            const auto step = maker(beside)->make(0);
            ASSERT_TRUE(step->file()) << file;
            expectField(*step, values[i]);
        }
    };
    expectEach(folder, StepMaker::Kept::Written);
    // They move together.
    fs::create_directory(folder / "moved");
    fs::rename(runs, folder / "moved/runs");
    expectEach(folder / "moved", StepMaker::Kept::Before);
}

}  // namespace
}  // namespace timeseries
