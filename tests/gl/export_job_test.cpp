#include "app/exploration/export_job.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "app/choices/session.h"
#include "app/choices/sweep_edits.h"
#include "tests/support/built_paths.h"
#include "tests/support/files.h"

namespace app {
namespace {

using State = ExportJob::State;

void pollToEnd(ExportJob& job) {
    for (job.poll(); job.state() == State::Running; job.poll()) std::this_thread::yield();
}

Explorer fire() {
    Explorer e;
    e.files = {tests::demo()};
    e.variable = "T";
    e.steps = StepChoice{3, 5};
    e.size = {64, 48};
    return e;
}

std::set<std::string> namesIn(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& each : std::filesystem::directory_iterator(folder))
        names.insert(each.path().filename());
    return names;
}

TEST(ExportJobOfTheProgram, WritesNumberedPictures) {
    const auto folder = tests::freshFolder();
    const FrameFiles frames(folder / "fire.png", fire(), {3, 4, 5}, 31);  // of the demo's steps
    ExportJob job(fire(), frames, tests::program());
    pollToEnd(job);
    ASSERT_EQ(job.state(), State::Done) << job.outcome();
    EXPECT_EQ(job.done(), 3u);
    std::set<std::string> names;
    for (std::size_t i = 0; i < frames.size(); ++i) names.insert(frames[i].file.filename());
    EXPECT_EQ(namesIn(folder), names);
    EXPECT_EQ(readSession(folder / "fire_04.png").steps, (StepChoice{4, 4}));
}

TEST(ExportJobOfTheProgram, HandsOnWhyItFailed) {
    const auto folder = tests::freshFolder();
    Explorer e = fire();
    e.files = {folder / "gone.nc"};
    ExportJob job(e, {folder / "fire.exr", e, {3, 4, 5}}, tests::program());
    pollToEnd(job);
    EXPECT_EQ(job.state(), State::Failed);
    EXPECT_THAT(job.outcome(), testing::HasSubstr("gone.nc"));
    EXPECT_THAT(namesIn(folder), testing::IsEmpty());
}

TEST(ExportJobOfTheProgram, LeavesWholePicturesOnlyWhenCancelled) {
    const auto folder = tests::freshFolder();
    Explorer e = fire();
    setSweep(e, timeseries::SweepSettings{.animation = timeseries::RangeSet::parse("300:1600"),
                                          .delta = 50,
                                          .timerSteps = 100000});
    ExportJob job(e, {folder / "fire.png", e, {3, 4, 5}}, tests::program());
    for (job.poll(); job.done() < 2; job.poll()) {
        ASSERT_EQ(job.state(), State::Running) << job.outcome();
        std::this_thread::yield();
    }
    job.cancel();
    pollToEnd(job);
    EXPECT_EQ(job.state(), State::Cancelled);
    EXPECT_GE(namesIn(folder).size(), 2u);
    EXPECT_THAT(job.outcome(), testing::StartsWith(fmt::format("Export cancelled after {} of ",
                                                               namesIn(folder).size())));
    for (const std::string& name : namesIn(folder)) {
        EXPECT_THAT(name, testing::EndsWith(".png"));
        EXPECT_NO_THROW(readSession(folder / name)) << name;
    }
}

}  // namespace
}  // namespace app
