#include "app/exploration/export_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "app/choices/session.h"
#include "app/choices/sweep_edits.h"
#include "render/image/picture_file.h"
#include "tests/support/files.h"
#include "tests/support/variable.h"

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
    e.steps = StepChoice{2, 4};
    return e;
}

// Three pictures.
FrameFiles into(const std::filesystem::path& output) { return {output, example(), {2, 3, 4}}; }

TEST(ExportJob, TellsItsProgressAndGivesItsSession) {
    const auto folder = tests::freshFolder();
    const auto copy = folder / "copy.json";
    ExportJob job(example(), into(folder / "out.png"),
                  programOf("[ $1 = render ] && [ $2 = --session ] && [ $4 = --progress ] && "
                            "[ $5 = -o ] && cp $3 " +
                            copy.string() +
                            "; echo picture 1 of 3; echo told; echo picture 2 of 3; echo $6 > " +
                            (folder / "named").string()));
    pollToEnd(job);
    EXPECT_EQ(job.state(), State::Done);
    EXPECT_EQ(job.done(), 2u);
    EXPECT_EQ(job.outcome(),
              fmt::format("Exported 3 pictures: {}/out_2.png to out_4.png", folder.string()));
    EXPECT_EQ(tests::readBytes(folder / "named"), (folder / "out.png").string() + "\n");
    const auto session = nlohmann::json::parse(tests::readBytes(copy));
    EXPECT_EQ(fromJson(session, std::filesystem::temp_directory_path()), example());
}

TEST(ExportJob, AChildThatFailsHandsOnItsSentence) {
    tests::freshFolder();
    ExportJob job(
        example(), into("out.png"),
        programOf("echo warning >&2; echo 'isochron: a.nc: cannot be opened' >&2; exit 1"));
    pollToEnd(job);
    EXPECT_EQ(job.state(), State::Failed);
    EXPECT_EQ(job.outcome(), "a.nc: cannot be opened");
    ExportJob silent(example(), into("out.png"), programOf("exit 3"));
    pollToEnd(silent);
    EXPECT_THAT(silent.outcome(), HasSubstr("exit code 3"));
    ExportJob killed(example(), into("out.png"), programOf("kill -9 $$"));
    pollToEnd(killed);
    EXPECT_EQ(killed.state(), State::Failed);
    EXPECT_THAT(killed.outcome(), HasSubstr("signal 9"));
}

TEST(ExportJob, IsCancelledAndItsPartialPictureRemoved) {
    const auto folder = tests::freshFolder();
    tests::writeBytes(folder / "out_0.png", "done");
    tests::writeBytes(folder / "out_3.png.isochron-part0", "half");
    // Of other pictures, whose names begin or end alike, or of no picture.
    const auto others = {
        "other.png.isochron-part0", "out_b_07.png.isochron-part0", "out_1.png.isochron-part0",
        "out.png.isochron-part0",   "out_3.exr.isochron-part0",    "out_3.png.isochron-parts",
        "out_3.png.isochron-part",  "out_03.png.isochron-part0",   "out_3_left.png.isochron-part0"};
    for (const char* other : others) tests::writeBytes(folder / other, "not its own");
    // Another program writes a picture of the same name.
    render::PartialFile written(folder / "out_4.png");
    ExportJob job(example(), into(folder / "out.png"),
                  programOf("echo picture 1 of 2; exec sleep 1000"));
    pollUntil(job, [&] { return job.done() == 1; });
    EXPECT_EQ(job.state(), State::Running);
    job.cancel();
    pollToEnd(job);
    EXPECT_EQ(job.state(), State::Cancelled);
    EXPECT_EQ(job.outcome(),
              "Export cancelled after 1 of 3 pictures, which stay in " + folder.string());
    EXPECT_TRUE(std::filesystem::exists(folder / "out_0.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out_3.png.isochron-part0"));
    for (const char* other : others) EXPECT_TRUE(std::filesystem::exists(folder / other)) << other;
    EXPECT_NO_THROW(written.commit());
}

TEST(ExportJob, OfAnEyeAPictureItRemovesThePartsOfBoth) {
    const auto folder = tests::freshFolder();
    Explorer e = example();
    e.stereo.mode = Stereo::LeftRight;
    for (const char* eye : {"left", "right"})
        tests::writeBytes(folder / fmt::format("out_2_{}.png.isochron-part0", eye), "half");
    ExportJob job(e, {folder / "out.png", e, {2, 3, 4}}, programOf("exit 1"));
    pollToEnd(job);
    for (const auto& each : std::filesystem::directory_iterator(folder))
        EXPECT_EQ(each.path().filename(), "program");
}

// Names of another encoding: an e with an acute accent in Latin-1.
TEST(ExportJob, GivesTheNamesOfFilesThatAreNoUtf8) {
    const auto folder = tests::freshFolder();
    Explorer e = example();
    e.files = {folder / "n\xe9.nc"};
    const auto copy = folder / "copy.json";
    ExportJob job(e, into(folder / "out.png"), programOf("cp $3 " + copy.string()));
    pollToEnd(job);
    EXPECT_EQ(readSession(copy), e);
}

TEST(ExportJob, AFolderOfPassingFilesThatIsNotThereIsNamed) {
    const auto gone = (tests::freshFolder() / "gone").string();
    const tests::Variable temporary("TMPDIR", gone);
    try {
        ExportJob job(example(), into("out.png"), programOf("exit 0"));
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("the export cannot be started: '" + gone +
                                            "', which TMPDIR names: "));
    }
}

TEST(ExportJob, IsCancelledBeforeItsFirstPicture) {
    const auto folder = tests::freshFolder();
    ExportJob job(example(), into(folder / "out.png"), programOf("exec sleep 1000"));
    job.cancel();
    pollToEnd(job);
    EXPECT_EQ(job.outcome(), "Export cancelled before its first picture");
}

TEST(ExportJob, SaysHowFarItCameWhereItIsEnded) {
    const auto folder = tests::freshFolder();
    ExportJob job(example(), into(folder / "out.png"),
                  programOf("echo picture 2 of 3; exec sleep 1000"));
    pollUntil(job, [&] { return job.done() == 2; });
    EXPECT_EQ(job.end(),
              "Export cancelled after 2 of 3 pictures, which stay in " + folder.string());
    ExportJob whole(example(), into(folder / "out.png"), programOf("echo picture 3 of 3"));
    pollToEnd(whole);
    EXPECT_THAT(whole.end(), HasSubstr("Exported 3 pictures"));
}

TEST(ExportJob, DroppingItEndsTheChildAndLeavesNothingOfIt) {
    const auto folder = tests::freshFolder();
    const auto half = folder / "out_3.png.isochron-part0", child = folder / "child",
               session = folder / "session";
    const auto program =
        programOf("echo $$ > " + child.string() + "; printf %s \"$3\" > " + session.string() +
                  "; echo half > " + half.string() + "; echo picture 1 of 3; exec sleep 1000");
    {
        ExportJob job(example(), into(folder / "out.png"), program);
        pollUntil(job, [&] { return job.done() == 1; });
        EXPECT_TRUE(std::filesystem::exists(half));
        EXPECT_TRUE(std::filesystem::exists(tests::readBytes(session)));
    }
    EXPECT_FALSE(std::filesystem::exists(half));
    EXPECT_FALSE(std::filesystem::exists(tests::readBytes(session)));
    EXPECT_EQ(kill(std::stoi(tests::readBytes(child)), 0), -1);
}

TEST(ExportJob, AProgramThatIsNotThereIsTold) {
    try {
        ExportJob job(example(), into("out.png"), tests::freshFolder() / "gone");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("gone"));
    }
}

TEST(ExportJob, AFloodOfWordsDoesNotStopIt) {
    tests::freshFolder();
    ExportJob job(example(), into("out.png"),
                  programOf("i=0; while [ $i -lt 4000 ]; do echo "
                            "'a line of fifty letters or so, of no use to anyone at all'; "
                            "i=$((i+1)); done >&2; echo 'isochron: the end' >&2; exit 1"));
    pollToEnd(job);
    EXPECT_EQ(job.outcome(), "the end");
}

// An animation of ten steps of noise.
class AnimationOf : public testing::Test {
 protected:
    AnimationOf() {
        auto time = std::make_shared<timeseries::TimeAxis>();
        time->points.resize(kSteps);
        dataset_.variable.time = time;
        explorer_.steps = StepChoice{3, 3};
        explorer_.layers = {
            {.ranges = timeseries::RangeSet::parse("0:0.25"), .color = {}, .opacity = {}}};
    }
    Explorer animation() const { return animationOf(explorer_, dataset_); }

    static constexpr std::size_t kSteps = 10;
    Dataset dataset_;
    Explorer explorer_;
};

TEST_F(AnimationOf, IsWhatPlays) {
    PlayChoice& play = explorer_.play;
    setSweep(explorer_, {.animation = timeseries::RangeSet::parse("0:1"), .delta = 0.1});
    play.time.first = 2;
    play.tick = 40;
    EXPECT_EQ(animation().steps, (StepChoice{2, 9}));
    EXPECT_EQ(animation().layers, explorer_.layers);
    EXPECT_FALSE(animation().oneTick);
    play.timeMoves = false;
    EXPECT_EQ(animation().steps, (StepChoice{3, 3}));
    play.timeMoves = true;
    play.sweepMoves = false;
    EXPECT_EQ(animation().steps, (StepChoice{2, 9}));
    EXPECT_EQ(animation().layers, explorer_.layers);
    EXPECT_TRUE(animation().oneTick);
    EXPECT_EQ(animation().play.tick, 40);
}

// The cursor that plays is the oracle: once, forward, whatever way and end were chosen.
TEST_F(AnimationOf, PassesOnceTheStepsThatPlayPasses) {
    std::mt19937 random(17);
    for (int i = 0; i < 500; ++i) {
        timeseries::CursorSettings& time = explorer_.play.time;
        time = {.first = random() % kSteps, .stride = 1 + random() % (kSteps + 2)};
        if (random() % 3 != 0) time.last = time.first + random() % kSteps;
        time.direction = static_cast<timeseries::Direction>(random() % 2);
        time.ending = static_cast<timeseries::Ending>(random() % 3);
        timeseries::CursorSettings once = time;
        once.direction = timeseries::Direction::Forward;
        once.ending = timeseries::Ending::Once;
        const timeseries::TimeCursor cursor(kSteps, once);
        std::vector<std::size_t> passed;
        for (std::size_t place = 0; place < cursor.placesPerCycle(); ++place)
            passed.push_back(cursor.stepOfPlace(place));
        EXPECT_EQ(stepsOf(dataset_, *animation().steps), passed)
            << time.first << ':' << time.last << ':' << time.stride;
    }
}

}  // namespace
}  // namespace app
