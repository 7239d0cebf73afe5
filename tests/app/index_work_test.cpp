#include "app/command/index_work.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "tests/support/random_field.h"
#include "timeseries/readers/reader.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using timeseries::StepMaker;
using timeseries::StepStore;

// A series of arrays, a step a file.
class IndexWorks : public testing::Test {
 protected:
    static constexpr std::size_t kSteps = 6;
    fs::path folder = tests::freshFolder();
    IndexOptions options;
    std::vector<IndexTask> tasks;

    void SetUp() override {
        for (std::size_t s = 0; s < kSteps; ++s) {
            std::string values(16 * 16 * 16, '\0');
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = static_cast<char>(i * (s + 7) % 100);
            tests::writeBytes(nameOf(s),
                              "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 16 16 16\n"
                              "encoding: raw\n\n" +
                                  values);
            tasks.push_back({"f", s});
        }
        options.files = {nameOf(0)};
    }
    fs::path nameOf(std::size_t step) const { return folder / fmt::format("f_{:02}.nrrd", step); }
    std::shared_ptr<StepStore> storeOf(std::uint64_t budget = StepStore::kNoBudget) const {
        return std::make_shared<StepStore>(folder / "steps", timeseries::StoreKind::Cache, budget,
                                           std::chrono::milliseconds(0));
    }
    struct Told {
        IndexedSteps done;
        int code;
        std::string out, err;
    };
    Told index(const std::shared_ptr<StepStore>& store) const {
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        IndexedSteps done;
        {
            IndexProgress progress(tasks.size(), IndexProgress::Shown::No);
            IndexWork work(options, store, tasks, tasks, progress);
            work.work();
            done = work.done();
        }
        const int code = tellIndexed(done, *store);
        return {done, code, testing::internal::GetCapturedStdout(),
                testing::internal::GetCapturedStderr()};
    }
};

TEST_F(IndexWorks, StepsOfOneRequestDoNotMakeRoomForEachOther) {
    ASSERT_EQ(index(storeOf()).code, 0);
    std::uint64_t whole = 0;
    for (const auto& file : storeOf()->list()) whole += file.bytes;
    storeOf()->clear();
    // Two of another series are there, and have to go.
    for (const char* name : {"p", "q"}) {
        IndexOptions of = options;
        of.files = {folder / fmt::format("{}.nrrd", name)};
        fs::copy_file(nameOf(0), of.files[0]);
        IndexProgress progress(1, IndexProgress::Shown::No);
        IndexWork work(of, storeOf(), {{name, 0}}, {}, progress);
        work.work();
    }
    ASSERT_EQ(storeOf()->list().size(), 2u);

    const std::uint64_t budget = whole * 9 / 12;
    const auto small = [&] { return storeOf(budget); };
    const Told first = index(small());
    EXPECT_EQ(first.code, 1);
    EXPECT_EQ(first.done.of(StepMaker::Kept::Written), 4u);
    EXPECT_EQ(first.done.of(StepMaker::Kept::NoRoom), 2u);
    EXPECT_EQ(storeOf()->list().size(), 4u);
    EXPECT_THAT(first.out, HasSubstr("4 written, 0 there before; not kept: 2 for want of room"));
    EXPECT_THAT(first.err, AllOf(HasSubstr("2 of these steps did not fit"),
                                 HasSubstr("would hold all of them")));
    // And again: what is there stays.
    const Told second = index(small());
    EXPECT_EQ(second.code, 1);
    EXPECT_EQ(second.done.of(StepMaker::Kept::Before), 4u);
    EXPECT_EQ(second.done.of(StepMaker::Kept::NoRoom), 2u);
    EXPECT_EQ(storeOf()->list().size(), 4u);
}

// Whoever has it open reads on; what is read is of no file that anybody could look at again.
TEST_F(IndexWorks, AStepWhoseFileIsRemovedHasFailed) {
    const auto store = storeOf();
    const fs::path file = nameOf(0);
    StepMaker maker(timeseries::openReader(std::span(&file, 1)), 0,
                    timeseries::RangeSet::everything(), timeseries::StepStores{{store}, store, 1});
    EXPECT_EQ(maker.keep(0), StepMaker::Kept::Written);
    fs::remove(file);
    const auto isGone =
        testing::ThrowsMessage<timeseries::FileError>(HasSubstr("f_00.nrrd: it has been removed"));
    EXPECT_THAT([&] { (void)maker.keep(0); }, isGone);
    EXPECT_THAT([&] { (void)maker.keepNoMore(0); }, isGone);
}

// Another run may keep it.
TEST_F(IndexWorks, AStepOfTheFutureIsNotKeptAndMissing) {
    fs::last_write_time(nameOf(3), fs::file_time_type::clock::now() + std::chrono::hours(1));
    const Told told = index(storeOf());
    EXPECT_EQ(told.done.of(StepMaker::Kept::Written), kSteps - 1);
    EXPECT_EQ(told.code, 1);
    EXPECT_THAT(told.out, HasSubstr("not kept: 1 whose files changed meanwhile"));
}

TEST_F(IndexWorks, WhatSeveralStepsFailAtIsToldOnce) {
    IndexedSteps done;
    done.fail("one");
    done.fail("several");
    done.fail("one", 2);
    done.fail("several", 1000);
    EXPECT_EQ(done.failed, 1004u);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    done.fail("alone");
    EXPECT_EQ(tellIndexed(done, *storeOf()), 1);
    EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("1005 steps: 0 written"));
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "isochron: one (3 steps)\nisochron: several (1,001 steps)\nisochron: alone\n");
}

// A million floats take 4 MB, their list 4, and a quarter more of what else there is; three
// quarters of the memory are for the steps.
TEST(FitsEach, OfTheProcessesThatShareAMachinesMemory) {
    timeseries::Variable of;
    of.type = timeseries::ValueType::F32;
    of.grid = tests::gridOf(std::array<std::size_t, 3>{100, 100, 100});
    for (const unsigned processes : {1u, 2u, 8u}) {
        const std::uint64_t needed = 12'000'000ull * processes / 3 * 4;
        EXPECT_TRUE(fitsEach(of, needed + 100, processes));
        EXPECT_FALSE(fitsEach(of, needed - 100, processes));
    }
}

// Of ten: what is there by now took no time, and tells nothing of the others.
TEST(IndexProgress, TellsWhatIsLeftByWhatWasWritten) {
    EXPECT_EQ(indexProgressText(10, 0, 0, 0, 0.5), "step 1 of 10, 0 %");
    EXPECT_EQ(indexProgressText(10, 0, 0, 0.5, 3), "step 1 of 10, 5 %, at most 57 s left");
    EXPECT_EQ(indexProgressText(10, 6, 4, 0.5, 5), "step 7 of 10, 65 %, at most 7 s left");
    EXPECT_EQ(indexProgressText(10, 4, 4, 0, 1), "step 5 of 10, 40 %");
    EXPECT_EQ(indexProgressText(1, 0, 0, 0.25, 2), "25 %, at most 6 s left");
}

}  // namespace
}  // namespace app
