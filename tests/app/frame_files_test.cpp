#include "app/files/frame_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "app/choices/sweep_edits.h"
#include "tests/support/files.h"

namespace app {
namespace {

using testing::ElementsAre;

std::vector<std::string> filesOf(const FrameFiles& frames) {
    std::vector<std::string> files;
    for (std::size_t i = 0; i < frames.size(); ++i) files.push_back(frames[i].file.string());
    return files;
}

std::vector<std::size_t> stepsOf(const FrameFiles& frames) {
    std::vector<std::size_t> steps;
    for (std::size_t i = 0; i < frames.size(); ++i) steps.push_back(frames[i].step);
    return steps;
}

Explorer sweeping(std::int64_t timerSteps, std::int64_t step = 1) {
    Explorer e;
    setSweep(e, timeseries::SweepSettings{.animation = timeseries::RangeSet::parse("0:1"),
                                          .timerSteps = timerSteps,
                                          .step = step});
    return e;
}

TEST(FrameFiles, AreOneAStepUnderItsNumber) {
    const FrameFiles frames("out/fire.png", {}, {3, 7, 11});
    EXPECT_THAT(stepsOf(frames), ElementsAre(3, 7, 11));
    EXPECT_THAT(filesOf(frames), ElementsAre("out/fire_03.png", "out/fire_07.png",  //
                                             "out/fire_11.png"));
    EXPECT_EQ(frames[1].tick, 0);
    EXPECT_EQ(frames.names(), "out/fire_03.png to fire_11.png");
}

// So that two runs' pictures of one series lie in order.
TEST(FrameFiles, HaveAsManyDigitsAsTheSeriesLastStep) {
    EXPECT_THAT(filesOf(FrameFiles("f.png", {}, {3, 7}, 31)), ElementsAre("f_03.png", "f_07.png"));
    EXPECT_THAT(filesOf(FrameFiles("f.png", {}, {3, 7}, 10)), ElementsAre("f_3.png", "f_7.png"));
    EXPECT_THAT(filesOf(FrameFiles("f.png", {}, {3, 7}, 101)),
                ElementsAre("f_003.png", "f_007.png"));
}

TEST(FrameFiles, OneAloneHasTheNameAskedFor) {
    Explorer e;
    EXPECT_THAT(filesOf(FrameFiles("fire.exr", e, {41})), ElementsAre("fire.exr"));
    EXPECT_EQ(FrameFiles("fire.exr", e, {41}).names(), "fire.exr");
    EXPECT_THAT(filesOf(FrameFiles("fire.png", sweeping(8, 8), {0, 1})), ElementsAre("fire.png"));
}

TEST(FrameFiles, OfTwoEyesAreNamedByBoth) {
    Explorer e;
    e.stereo.mode = Stereo::LeftRight;
    EXPECT_EQ(FrameFiles("a/b.png", e, {5}).names(), "a/b_left.png and b_right.png");
    EXPECT_EQ(FrameFiles("a/b.png", e, {5, 6}).names(), "a/b_5_left.png to b_6_right.png");
    e.stereo.mode = Stereo::SideBySide;
    EXPECT_EQ(FrameFiles("a/b.png", e, {5}).names(), "a/b.png");
}

TEST(FrameFiles, KnowWhichOfTheirFilesThereAre) {
    const auto folder = tests::freshFolder();
    const auto make = [&](const char* name) { tests::writeBytes(folder / name, ""); };
    const FrameFiles steps(folder / "fire.png", {}, {3, 7, 11});
    EXPECT_EQ(steps.fileCount(), 3u);
    EXPECT_EQ(steps.existing(), 0u);
    // None of these is one of its pictures.
    for (const char* name : {"fire.png", "fire_05.png", "fire_3.png", "fire_003.png", "fire_.png",
                             "fire_07.exr", "fire_07_left.png", "f", "other_07.png"})
        make(name);
    EXPECT_EQ(steps.existing(), 0u);
    make("fire_03.png");
    make("fire_11.png");
    EXPECT_EQ(steps.existing(), 2u);
    EXPECT_EQ(FrameFiles(folder / "fire.png", {}, {3}).existing(), 1u);
    Explorer e;
    e.stereo.mode = Stereo::LeftRight;
    const FrameFiles eyes(folder / "fire.png", e, {3, 7, 11});
    EXPECT_EQ(eyes.fileCount(), 6u);
    EXPECT_EQ(eyes.existing(), 1u) << "the left one of 7";
    // Of a million there are few: not each is looked for.
    const FrameFiles swept(folder / "fire.png", sweeping(1 << 29), {0});
    make("fire_000000000.png");
    EXPECT_EQ(swept.existing(), 1u);
    EXPECT_EQ(FrameFiles(folder / "none" / "fire.png", {}, {1, 2}).existing(), 0u);
}

TEST(FrameFiles, OfASweepThatStandsAreOneAStepAtItsTick) {
    Explorer e = sweeping(10, 3);
    e.oneTick = true;
    e.play.tick = 2;
    EXPECT_THAT(filesOf(FrameFiles("s.png", e, {5})), ElementsAre("s.png"));
    const FrameFiles frames("s.png", e, {5, 6});
    EXPECT_THAT(stepsOf(frames), ElementsAre(5, 6));
    EXPECT_THAT(filesOf(frames), ElementsAre("s_5.png", "s_6.png"));
    EXPECT_EQ(frames[0].tick, 2);
    EXPECT_EQ(frames[1].tick, 2);
}

TEST(FrameFiles, OfASweepAreOneATick) {
    // 10 timer steps by 3: the counts 0, 3, 6 and 9.
    const FrameFiles frames("s.png", sweeping(10, 3), {5});
    ASSERT_EQ(frames.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(frames[i].tick, static_cast<std::int64_t>(i));
        EXPECT_EQ(frames[i].step, 5u);
    }
    EXPECT_EQ(frames.names(), "s_0.png to s_3.png");
}

TEST(FrameFiles, OfOneCycleOfASweepSpanTheStepsOnce) {
    for (const std::size_t count : {1u, 2u, 5u, 7u, 64u}) {
        std::vector<std::size_t> steps;
        for (std::size_t i = 0; i < count; ++i) steps.push_back(2 + 3 * i);
        const FrameFiles frames("s.png", sweeping(64), steps);
        ASSERT_EQ(frames.size(), 64u);
        const std::vector<std::size_t> shown = stepsOf(frames);
        EXPECT_TRUE(std::ranges::is_sorted(shown));
        std::map<std::size_t, std::size_t> times;
        for (const std::size_t step : shown) ++times[step];
        ASSERT_EQ(times.size(), count);
        for (const std::size_t step : steps) {
            EXPECT_GE(times[step], 64 / count) << step;
            EXPECT_LE(times[step], 64 / count + 1) << step;
        }
    }
}

TEST(FrameFiles, OfASweepWithFewerTicksThanStepsLeaveStepsOutAndSaySo) {
    const std::vector<std::size_t> steps = {0, 1, 2, 3, 4, 5, 6};
    const FrameFiles few("s.png", sweeping(4), steps);
    EXPECT_EQ(few.leftOut(), "3 of 7 steps have no picture: the sweep has 4 ticks");
    EXPECT_EQ(FrameFiles("s.png", sweeping(6), steps).leftOut(),
              "1 of 7 steps has no picture: the sweep has 6 ticks");
    const std::vector<std::size_t> shown = stepsOf(few);
    for (std::size_t i = 1; i < shown.size(); ++i) EXPECT_LT(shown[i - 1], shown[i]);
    EXPECT_EQ(FrameFiles("s.png", sweeping(7), steps).leftOut(), "");
    EXPECT_EQ(FrameFiles("s.png", {}, steps).leftOut(), "");
    Explorer stands = sweeping(4);
    stands.oneTick = true;
    EXPECT_EQ(FrameFiles("s.png", stands, steps).leftOut(), "");
}

TEST(FrameFiles, OfTheLongestCycleTakeNoRoom) {
    const FrameFiles frames("s.png", sweeping(std::int64_t{1} << 30), {0, 1});
    EXPECT_EQ(frames.size(), std::size_t{1} << 30);
    EXPECT_EQ(frames.back().step, 1u);
    EXPECT_EQ(frames[frames.size() / 2 - 1].step, 0u);
    EXPECT_EQ(frames.back().file, "s_1073741823.png");
}

}  // namespace
}  // namespace app
