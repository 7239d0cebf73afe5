#include "app/export_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "app/session.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

// Programs of a line of shell stand for isochron; tests/gl/export_job_test.cpp has the real one.
namespace app {
namespace {

using testing::HasSubstr;
using State = ExportJob::State;

// Its arguments are `render --session $3 --progress -o $6`.
std::filesystem::path programOf(const std::string& line) {
    const auto file = tests::testFolder() / "program";
    tests::writeBytes(file, "#!/bin/sh\n" + line + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
}

template <typename Condition>
void pollUntil(ExportJob& job, const Condition& holds) {
    for (job.poll(); !holds(); job.poll()) std::this_thread::yield();
}

void pollToEnd(ExportJob& job) {
    pollUntil(job, [&] { return job.state() != State::Running; });
}

Explorer example() {
    Explorer e;
    e.files = {tests::testFolder() / "a.nc"};
    e.steps = StepChoice{2, 7};
    return e;
}

TEST(ExportJob, TellsItsProgressAndGivesItsSession) {
    const auto folder = tests::freshFolder();
    const auto copy = folder / "copy.json";
    ExportJob job(example(), folder / "out.png",
                  programOf("[ $1 = render ] && [ $2 = --session ] && [ $4 = --progress ] && "
                            "[ $5 = -o ] && cp $3 " +
                            copy.string() +
                            "; echo picture 1 of 3; echo told; echo picture 2 of 3; echo $6 > " +
                            (folder / "named").string()));
    pollToEnd(job);
    EXPECT_EQ(job.state(), State::Done);
    EXPECT_EQ(job.done(), 2u);
    EXPECT_EQ(job.count(), 3u);
    EXPECT_EQ(tests::readBytes(folder / "named"), (folder / "out.png").string() + "\n");
    const auto session = nlohmann::json::parse(tests::readBytes(copy));
    EXPECT_EQ(fromJson(session, std::filesystem::temp_directory_path()), example());
}

TEST(ExportJob, AChildThatFailsHandsOnItsSentence) {
    tests::freshFolder();
    ExportJob job(
        example(), "out.png",
        programOf("echo warning >&2; echo 'isochron: a.nc: cannot be opened' >&2; exit 1"));
    pollToEnd(job);
    EXPECT_EQ(job.state(), State::Failed);
    EXPECT_EQ(job.why(), "a.nc: cannot be opened");
    ExportJob silent(example(), "out.png", programOf("exit 3"));
    pollToEnd(silent);
    EXPECT_THAT(silent.why(), HasSubstr("exit code 3"));
    ExportJob killed(example(), "out.png", programOf("kill -9 $$"));
    pollToEnd(killed);
    EXPECT_EQ(killed.state(), State::Failed);
    EXPECT_THAT(killed.why(), HasSubstr("signal 9"));
}

TEST(ExportJob, IsCancelledAndItsPartialPictureRemoved) {
    const auto folder = tests::freshFolder();
    tests::writeBytes(folder / "out_0.png", "done");
    tests::writeBytes(folder / "out_1.png.part0", "half");
    tests::writeBytes(folder / "other.png.part0", "not its own");
    ExportJob job(example(), folder / "out.png", programOf("echo picture 1 of 2; exec sleep 1000"));
    pollUntil(job, [&] { return job.done() == 1; });
    EXPECT_EQ(job.state(), State::Running);
    job.cancel();
    pollToEnd(job);
    EXPECT_EQ(job.state(), State::Cancelled);
    EXPECT_EQ(job.why(), "");
    EXPECT_TRUE(std::filesystem::exists(folder / "out_0.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out_1.png.part0"));
    EXPECT_TRUE(std::filesystem::exists(folder / "other.png.part0"));
}

TEST(ExportJob, DroppingItEndsTheChild) {
    const auto folder = tests::freshFolder();
    const auto program = programOf("echo picture 1 of 2; exec sleep 1000");
    {
        ExportJob job(example(), folder / "out.png", program);
        pollUntil(job, [&] { return job.done() == 1; });
        // Half a picture, that is removed when the child has ended.
        tests::writeBytes(folder / "out_1.png.part0", "half");
    }
    while (std::filesystem::exists(folder / "out_1.png.part0")) std::this_thread::yield();
}

TEST(ExportJob, AProgramThatIsNotThereIsTold) {
    try {
        ExportJob job(example(), "out.png", tests::freshFolder() / "gone");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("gone"));
    }
}

TEST(ExportJob, AFloodOfWordsDoesNotStopIt) {
    tests::freshFolder();
    ExportJob job(example(), "out.png",
                  programOf("i=0; while [ $i -lt 4000 ]; do echo "
                            "'a line of fifty letters or so, of no use to anyone at all'; "
                            "i=$((i+1)); done >&2; echo 'isochron: the end' >&2; exit 1"));
    pollToEnd(job);
    EXPECT_EQ(job.why(), "the end");
}

TEST(AnimationOf, IsWhatPlays) {
    Dataset dataset;
    auto time = std::make_shared<timeseries::TimeAxis>();
    time->points.resize(10);
    dataset.about.time = time;
    const auto sorted =
        std::make_shared<const timeseries::SortedStep>(tests::noise(tests::cube(4)));
    Explorer e;
    e.steps = StepChoice{3, 3};
    e.layers = {{.ranges = timeseries::RangeSet::parse("0:0.25"), .color = {}, .opacity = {}}};
    e.sweep =
        timeseries::SweepSettings{.animation = timeseries::RangeSet::parse("0:1"), .delta = 0.1};
    e.play.time.first = 2;
    e.play.tick = 40;
    const auto animation = [&] { return animationOf({e, dataset, 3, sorted}); };
    EXPECT_EQ(animation().steps, (StepChoice{2, 9}));
    EXPECT_EQ(animation().sweep, e.sweep);
    e.play.timeMoves = false;
    EXPECT_EQ(animation().steps, (StepChoice{3, 3}));
    e.play.timeMoves = true;
    e.play.sweepMoves = false;
    EXPECT_EQ(animation().steps, (StepChoice{2, 9}));
    EXPECT_FALSE(animation().sweep);
    ASSERT_EQ(animation().layers.size(), 2u);
    const auto window = timeseries::ValueSweep(*e.sweep).window(40);
    EXPECT_EQ(animation().layers[0].ranges, timeseries::RangeSet(std::vector{window}));
}

}  // namespace
}  // namespace app
