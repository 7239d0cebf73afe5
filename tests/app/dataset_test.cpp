#include "app/files/dataset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/files.h"
#include "tests/support/netcdf_builder.h"

namespace app {
namespace {

using testing::HasSubstr;
using timeseries::FileError;
using timeseries::TimeAxis;

TEST(TimeText, IsTheDateTheNumberOrTheStep) {
    const TimeAxis dates{
        "time", "days since 2000-01-01", "standard", {{3.5, "2000-01-04 12:00:00"}}};
    EXPECT_EQ(timeText(dates, 0), "2000-01-04 12:00:00");
    const TimeAxis seconds{"time", "s", "", {{0.5, ""}, {1.1, ""}}};
    EXPECT_EQ(timeText(seconds, 1), "1.1 s");
    const TimeAxis unitless{"cycle", "", "", {{2000, ""}}};
    EXPECT_EQ(timeText(unitless, 0), "cycle 2000");
    const TimeAxis one{"cycle", "1", "", {{2000, ""}}};
    EXPECT_EQ(timeText(one, 0), "cycle 2000");
    const TimeAxis counted{"step", "", "", {{0, ""}, {1, ""}, {2, ""}, {3, ""}}, true};
    EXPECT_EQ(timeText(counted, 3), "step 3");
    const TimeAxis missing{"time", "days since 2000-01-01", "standard", {{std::nan(""), ""}}};
    EXPECT_EQ(timeText(missing, 0), "no time");
}

TEST(TimeText, ATimeMayBeCalledStep) {
    const TimeAxis forecast{"step", "hours", "", {{6, ""}, {12, ""}}};
    EXPECT_EQ(timeText(forecast, 1), "12 hours");
}

// So that what stands in a movie's pictures, or below each other in a table, does not jump.
TEST(TimeText, HasAsManyDecimalsAsItsNeighbours) {
    TimeAxis axis{"time", "s", "", {}};
    for (int i = -2; i < 19; ++i) axis.points.push_back({0.05 * i, ""});
    EXPECT_EQ(timeText(axis, 0), "-0.10 s");
    EXPECT_EQ(timeText(axis, 1), "-0.05 s");
    EXPECT_EQ(timeText(axis, 2), "0.00 s");
    EXPECT_EQ(timeText(axis, 4), "0.10 s");
    EXPECT_EQ(timeText(axis, 20), "0.90 s");
    const TimeAxis whole{"cycle", "", "", {{0, ""}, {20, ""}, {1e12, ""}, {0.25, ""}}};
    EXPECT_EQ(timeText(whole, 0), "cycle 0.00");
    EXPECT_EQ(timeText(whole, 2), "cycle 1e+12");
    const TimeAxis uneven{"time", "s", "", {{0, ""}, {1, ""}, {1.125, ""}, {2.5, ""}}};
    EXPECT_EQ(timeText(uneven, 1), "1.0 s");
    EXPECT_EQ(timeText(uneven, 2), "1.125 s") << "no digit of its own is lost";
}

TEST(TimeText, TellsTimesApartHoweverFarTheyAreFromNought) {
    using Points = std::vector<timeseries::TimePoint>;
    const TimeAxis stamps{"number", "", "",
                          Points{{20000131123000, ""}, {20000131123100, ""}, {20000131123230, ""}}};
    EXPECT_EQ(timeText(stamps, 1), "number 20000131123100");
    const TimeAxis seconds{"time", "s", "",
                           Points{{12345678901.5, ""}, {12345678902.5, ""}, {12345678903.5, ""}}};
    EXPECT_EQ(timeText(seconds, 0), "12345678901.5 s");
    EXPECT_EQ(timeText(seconds, 2), "12345678903.5 s");
    const TimeAxis fine{"time", "s", "", Points{{1700000000.0001, ""}, {1700000000.0002, ""}}};
    EXPECT_EQ(timeText(fine, 0), "1700000000.0001 s");
    EXPECT_EQ(timeText(fine, 1), "1700000000.0002 s");
    // Which step of rounding it is, nobody is told.
    const TimeAxis rounded{"time", "s", "", Points{{0.1 + 0.2, ""}, {0.3, ""}}};
    EXPECT_EQ(timeText(rounded, 0), "0.3 s");
}

TEST(TimeText, KeepsTheDigitsOfStoredFloats) {
    const TimeAxis axis{"time", "s", "", {{0.1, ""}, {1.0 / 3, ""}, {1234567.5, ""}, {1e300, ""}}};
    EXPECT_EQ(timeText(axis, 0), "0.1 s");
    EXPECT_EQ(timeText(axis, 1), "0.3333333333 s");
    EXPECT_EQ(timeText(axis, 2), "1234567.5 s");
    EXPECT_EQ(timeText(axis, 3), "1e+300 s");
}

TEST(WithCommas, GroupsByThree) {
    EXPECT_EQ(withCommas(0), "0");
    EXPECT_EQ(withCommas(999), "999");
    EXPECT_EQ(withCommas(1000), "1,000");
    EXPECT_EQ(withCommas(13402), "13,402");
    EXPECT_EQ(withCommas(1234567890), "1,234,567,890");
    EXPECT_EQ(withCommas(std::numeric_limits<std::uint64_t>::max()), "18,446,744,073,709,551,615");
}

// Two variables of 3 steps on 2 x 2 x 2 points.
std::filesystem::path twoVariables() {
    tests::NetcdfBuilder file("two.nc");
    const auto t = file.coordinate("time", 3, "s"), z = file.coordinate("z", 2, "m"),
               y = file.coordinate("y", 2, "m"), x = file.coordinate("x", 2, "m");
    const int first =
        file.variable("first", NC_FLOAT, {t.dimension, z.dimension, y.dimension, x.dimension});
    const int second =
        file.variable("second", NC_FLOAT, {t.dimension, z.dimension, y.dimension, x.dimension});
    file.write(t.variable, std::vector<double>{0, 1, 2});
    for (const int axis : {z.variable, y.variable, x.variable})
        file.write(axis, std::vector<double>{0, 1});
    file.write(first, std::vector<float>(24, 1));
    file.write(second, std::vector<float>(24, 2));
    return file.close();
}

// v(time, 2, 2) in a file of exactly this name, in the test's folder.
std::filesystem::path timed(const std::filesystem::path& folder, const std::string& name,
                            const std::vector<double>& times, std::size_t nx = 2) {
    tests::NetcdfBuilder file(name);
    const auto t = file.coordinate("time", times.size(), "s");
    const int y = file.dimension("y", 2), x = file.dimension("x", nx);
    file.variable("v", NC_FLOAT, {t.dimension, y, x});
    file.write(t.variable, times);
    std::filesystem::rename(file.close(), folder / name);
    return folder / name;
}

OpenDataset open(const std::filesystem::path& file, const std::string& variable) {
    return openDataset(std::span(&file, 1), variable);
}

timeseries::Variable sized(const char* name, std::array<std::size_t, 3> n, std::size_t steps) {
    timeseries::Variable v;
    v.name = name;
    const auto axis = [](std::size_t length) {
        return timeseries::Axis{"a", "m", timeseries::indexCoordinates(length)};
    };
    v.grid =
        std::make_shared<const timeseries::Grid>(std::array{axis(n[0]), axis(n[1]), axis(n[2])});
    TimeAxis time;
    time.points.resize(steps);
    v.time = std::make_shared<const TimeAxis>(time);
    return v;
}

// They are kept as numbers, which are of other steps where that one's is another.
TEST(StepThen, TheInAndOutPointsGoWhereTheyAreOfOtherSteps) {
    const auto folder = tests::freshFolder();
    const auto was = open(timed(folder, "was.nc", {0, 1.5, 2, 3}), "v");
    Explorer session;
    session.steps = StepChoice{2, 2};
    session.stepTime = timeKept(*was.variable.time, 2);
    session.play.time.first = 1;
    session.play.time.last = 2;
    const auto inNow = [&](const std::vector<double>& times) {
        OpenDataset now = open(timed(folder, "now.nc", times), "v");
        Explorer e = session;
        findStepThen(now, e);
        return std::tuple(e.steps->first, e.play.time.first, e.play.time.last,
                          now.series.notes.size());
    };
    const timeseries::CursorSettings all;
    EXPECT_EQ(inNow({0, 1.5, 2, 3, 4}), std::tuple(2u, 1u, 2u, 0u));
    EXPECT_EQ(inNow({1.5, 2, 3}), std::tuple(1u, all.first, all.last, 2u));
    EXPECT_EQ(inNow({0, 1.5, 2.5}), std::tuple(2u, all.first, all.last, 2u));
    session.play.time = all;
    EXPECT_EQ(inNow({1.5, 2, 3}), std::tuple(1u, all.first, all.last, 1u)) << "all played";
}

TEST(StepThen, IsFoundByItsTimeInASeriesThatHasOthersBefore) {
    const auto folder = tests::freshFolder();
    const auto was = open(timed(folder, "was.nc", {0, 1.5, 2}), "v");
    const std::string kept = timeKept(*was.variable.time, 1);
    const auto then = [&](const std::vector<double>& times, std::size_t step) {
        OpenDataset now = open(timed(folder, "now.nc", times), "v");
        const std::size_t found = stepThen(now, step, kept);
        return std::pair(found, now.series.notes);
    };
    using Notes = std::vector<std::string>;
    EXPECT_EQ(then({0, 1.5, 2}, 1), std::pair(std::size_t{1}, Notes{}));
    EXPECT_EQ(then({0, 1.5}, 1), std::pair(std::size_t{1}, Notes{}));
    EXPECT_EQ(then({0, 1.5, 1.75, 2.125}, 1), std::pair(std::size_t{1}, Notes{}))
        << "however many digits its neighbours have";
    EXPECT_EQ(then({1.5, 2}, 1),
              std::pair(std::size_t{0}, Notes{"step 1, time 1.5 s, is step 0 now"}));
    EXPECT_EQ(then({-2, -1, 0, 1.5}, 1),
              std::pair(std::size_t{3}, Notes{"step 1, time 1.5 s, is step 3 now"}));
    const Notes gone{"step 1 was time 1.5 s, which no step of these is now"};
    EXPECT_EQ(then({0, 2}, 1), std::pair(std::size_t{1}, gone));
    EXPECT_EQ(then({0}, 1), std::pair(std::size_t{1}, gone));
    EXPECT_EQ(then({1.5, 0, 1.5}, 1), std::pair(std::size_t{1}, gone)) << "which of the two?";
    // Steps that are counted have their places alone.
    const TimeAxis counted{"step", "", "", {{0, ""}, {1, ""}}, true};
    EXPECT_EQ(timeKept(counted, 1), "");
}

TEST(DefaultVariable, HasTheMostLevelsThenStepsThenPoints) {
    const auto best = [](const std::vector<timeseries::Variable>& all) {
        return all[defaultVariable(all)].name;
    };
    const auto flat = sized("flat", {500, 500, 1}, 90), soil = sized("soil", {50, 50, 4}, 90),
               air = sized("air", {40, 40, 30}, 5), later = sized("later", {40, 40, 30}, 5),
               large = sized("large", {50, 40, 30}, 5), once = sized("once", {90, 90, 30}, 1),
               section = sized("section", {1, 64, 80}, 90);
    EXPECT_EQ(best({flat}), "flat");
    EXPECT_EQ(best({flat, soil, air}), "air");
    EXPECT_EQ(best({flat, once, air}), "air");
    EXPECT_EQ(best({air, large}), "large");
    EXPECT_EQ(best({later, air}), "later") << "of equals the file's first";
    EXPECT_EQ(best({section, air}), "air") << "a section is no volume";
    auto classes = sized("classes", {50, 40, 30}, 5), mask = sized("mask", {40, 40, 30}, 1),
         normals = sized("Normals magnitude", {40, 40, 30}, 5), dated = once;
    classes.categories = true;
    EXPECT_EQ(best({classes, air}), "air");
    EXPECT_EQ(best({normals, air}), "air");
    mask.time = std::make_shared<const timeseries::TimeAxis>(
        timeseries::TimeAxis{"step", "", "", {{0, ""}}, true});
    dated.time = std::make_shared<const timeseries::TimeAxis>(
        timeseries::TimeAxis{"time", "s", "", {{7, ""}}, false});
    dated.grid = mask.grid;
    EXPECT_EQ(best({mask, dated}), "once");
    EXPECT_EQ(best({mask}), "mask");
}

TEST(Dataset, TheDefaultVariableIsNotTheFilesFirst) {
    tests::NetcdfBuilder file("two.nc");
    const auto z = file.coordinate("z", 3, "m"), y = file.coordinate("y", 2, "m"),
               x = file.coordinate("x", 2, "m");
    file.variable("ground", NC_FLOAT, {y.dimension, x.dimension});
    file.variable("air", NC_FLOAT, {z.dimension, y.dimension, x.dimension});
    file.write(z.variable, std::vector<double>{0, 1, 2});
    for (const int axis : {y.variable, x.variable}) file.write(axis, std::vector<double>{0, 1});
    const auto path = file.close();
    EXPECT_EQ(open(path, "").variable.name, "air");
    EXPECT_EQ(open(path, "").variableIndex, 1u);
    EXPECT_EQ(open(path, "ground").variableIndex, 0u);
}

TEST(Dataset, AVariableIsChosenByNameOrTheFirst) {
    const auto file = twoVariables();
    EXPECT_EQ(open(file, "").variable.name, "first");
    EXPECT_EQ(open(file, "second").variable.name, "second");
    EXPECT_EQ(open(file, "second").stepCount(), 3u);
    EXPECT_EQ(open(file, "").name, file.string());
}

TEST(Dataset, AnUnknownVariableIsToldWithThoseThereAre) {
    const auto file = twoVariables();
    for (const char* name : {"third", "First", "first ", "time", " "}) {
        try {
            open(file, name);
            ADD_FAILURE() << name;
        } catch (const FileError& error) {
            EXPECT_THAT(error.what(), HasSubstr(file.string()));
            EXPECT_THAT(error.what(), HasSubstr("'" + std::string(name) + "'"));
            EXPECT_THAT(error.what(), HasSubstr("first, second"));
        }
    }
}

TEST(Dataset, ADamagedVariableIsToldAndCannotBeChosen) {
    tests::NetcdfBuilder file("damaged.nc");
    const int y = file.dimension("y", 2), x = file.dimension("x", 2);
    const int bad = file.variable("bad", NC_FLOAT, {y, x});
    file.variable("good", NC_FLOAT, {y, x});
    file.text(bad, "scale_factor", "two");
    const auto path = file.close();
    const std::string why = path.string() +
                            ": variable 'bad': scale_factor: expected a number, found the text "
                            "\"two\"";
    const Dataset dataset = open(path, "");
    EXPECT_EQ(dataset.variable.name, "good");
    EXPECT_THAT(dataset.series.notes, testing::ElementsAre("'bad' is left out: " + why));
    try {
        open(path, "bad");
        ADD_FAILURE();
    } catch (const FileError& error) {
        EXPECT_EQ(error.what(), why);
    }
}

TEST(Dataset, AMemberOpensItsSeriesAtItsOwnSteps) {
    const auto folder = tests::freshFolder();
    // By their times the files follow each other backwards.
    const auto last = timed(folder, "a_1.nc", {7, 8, 9}), first = timed(folder, "a_2.nc", {1}),
               middle = timed(folder, "a_3.nc", {4, 5});
    const Dataset dataset = open(last, "");
    EXPECT_EQ(dataset.stepCount(), 6u);
    EXPECT_EQ(dataset.defaultStep, 4u) << "the middle one of 7, 8, 9";
    EXPECT_EQ(dataset.name, last.string());
    EXPECT_EQ(open(first, "").defaultStep, 0u);
    EXPECT_EQ(open(middle, "").defaultStep, 2u);
    EXPECT_EQ(open(folder, "").defaultStep, 3u) << "the middle one of all";
    EXPECT_EQ(open(folder, "").stepCount(), 6u);
}

TEST(Dataset, SiblingsThatCannotBeJoinedAreLeftOutAndTold) {
    const auto folder = tests::freshFolder();
    const auto named = timed(folder, "a_1.nc", {1, 2, 3});
    timed(folder, "a_2.nc", {3, 4});
    const Dataset overlap = open(named, "");
    EXPECT_EQ(overlap.stepCount(), 3u);
    EXPECT_EQ(overlap.defaultStep, 1u);
    EXPECT_THAT(overlap.series.notes,
                testing::ElementsAre(testing::AllOf(HasSubstr("only this file is opened"),
                                                    HasSubstr("that do not overlap"))));
    timed(folder, "a_2.nc", {4}, 3);
    EXPECT_THAT(open(named, "").series.notes, testing::ElementsAre(HasSubstr("the same grid")));
    EXPECT_THROW(open(folder, ""), FileError) << "what is named is not left out";
    EXPECT_THROW(open(folder / "*.nc", ""), FileError);
    timed(folder, "a_2.nc", {4});
    EXPECT_EQ(open(named, "").stepCount(), 4u);
}

TEST(Dataset, AnUnreadableMemberIsNamed) {
    const auto folder = tests::freshFolder();
    const auto good = timed(folder, "a_1.nc", {1}), bad = folder / "a_2.nc";
    tests::writeBytes(bad, "no data");
    EXPECT_THAT(open(good, "").series.notes, testing::ElementsAre(HasSubstr(bad.string())));
    try {
        open(bad, "");
        ADD_FAILURE();
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), testing::StartsWith(bad.string() + ": expected"));
    }
}

TEST(Dataset, StepsAreThoseChosen) {
    const Dataset dataset = open(twoVariables(), "");
    EXPECT_EQ(stepsOf(dataset, {0, {}}), (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(stepsOf(dataset, {1, {}}), (std::vector<std::size_t>{1, 2}));
    EXPECT_EQ(stepsOf(dataset, {2, 2}), (std::vector<std::size_t>{2}));
    EXPECT_EQ(stepsOf(dataset, {0, 1}), (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(stepsOf(dataset, {0, {}, 2}), (std::vector<std::size_t>{0, 2}));
    EXPECT_EQ(stepsOf(dataset, {0, 1, 2}), (std::vector<std::size_t>{0}));
    EXPECT_EQ(stepsOf(dataset, {1, 2, std::numeric_limits<std::size_t>::max()}),
              (std::vector<std::size_t>{1}));
}

TEST(Dataset, AStepThatIsNotThereIsToldWithThoseThatAre) {
    const Dataset dataset = open(twoVariables(), "second");
    constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
    for (const auto& [steps, named] : {std::pair{StepChoice{3, 3}, std::size_t{3}},
                                       {{0, 3}, 3},
                                       {{7, {}}, 7},
                                       {{0, kMost}, kMost},
                                       {{kMost, kMost}, kMost}}) {
        try {
            stepsOf(dataset, steps);
            ADD_FAILURE() << steps.first;
        } catch (const FileError& error) {
            EXPECT_THAT(error.what(), HasSubstr(dataset.name));
            EXPECT_THAT(error.what(), HasSubstr("no step " + std::to_string(named)));
            EXPECT_THAT(error.what(), HasSubstr("second has steps 0 to 2"));
        }
    }
}

}  // namespace
}  // namespace app
