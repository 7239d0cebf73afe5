// Steps are in ascending time, however files and their names have them.
#include "timeseries/readers/ordered_reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "tests/support/array_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/timed_netcdf.h"

namespace timeseries::ordered_reader {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using tests::firstValues;
using tests::series;
using tests::timesOf;
using Path = std::filesystem::path;

constexpr const char* kTold = "steps are in order of time, in which the file has them not";

TEST(OrderedReader, OfOneFileStepsAreInOrderOfTheirTimes) {
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        std::vector<double> times;
        for (int i = 0; i < 12; ++i) times.push_back(0.25 * i);
        std::ranges::shuffle(times, random);
        if (round == 0) std::ranges::sort(times, std::greater());
        const Path path = series("a.nc", times, "days since 2001-03-01");
        const auto reader = tests::open(path);
        const auto found = firstValues(*reader);
        const TimeAxis& axis = *reader->variables()[0].time;
        ASSERT_EQ(found.size(), times.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            const auto stored = static_cast<std::size_t>(found[i]);  // its place in the file
            EXPECT_EQ(axis.points[i].value, 0.25 * double(i));
            EXPECT_EQ(times[stored], axis.points[i].value);
            EXPECT_EQ(reader->sources(0, i).step, stored);
            EXPECT_EQ(std::get<std::vector<float>>(reader->slab(0, i, {1, 0, 1}).values)[0],
                      found[i]);
        }
        EXPECT_EQ(axis.points[5].date, "2001-03-02 06:00:00");
        EXPECT_THAT(reader->variables()[0].notes, Contains(kTold));
        EXPECT_EQ(reader->stepsOf(0, 0)->count, 12u);
    }
}

TEST(OrderedReader, WhatAscendsIsAsItIs) {
    const auto reader = tests::open(series("a.nc", std::vector{1.0, 2.0, 2.0, 5.0}, "s"));
    EXPECT_THAT(timesOf(*reader), ElementsAre(1, 2, 2, 5));
    EXPECT_THAT(firstValues(*reader), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(reader->variables()[0].notes, Each(Not(HasSubstr("order of time"))));
}

// Files named backwards in time, each of which goes backwards.
TEST(OrderedReader, OfSeveralFilesStepsAreInOrderOfTheirTimes) {
    const std::vector<Path> paths{series("a_1.nc", std::vector{10.0, 9.0, 8.0}, "s", "", 10),
                                  series("a_2.nc", std::vector{5.0}, "s", "", 20),
                                  series("a_3.nc", std::vector{2.0, 1.0}, "s", "", 30)};
    const auto reader = openReader(paths);
    EXPECT_THAT(timesOf(*reader), ElementsAre(1, 2, 5, 8, 9, 10));
    EXPECT_THAT(firstValues(*reader), ElementsAre(31, 30, 20, 12, 11, 10));
    for (const auto& [file, first, count] :
         {std::tuple<std::size_t, std::size_t, std::size_t>{0, 3, 3}, {1, 2, 1}, {2, 0, 2}}) {
        EXPECT_EQ(reader->stepsOf(0, file)->first, first);
        EXPECT_EQ(reader->stepsOf(0, file)->count, count);
    }
    // What has no time is read as before.
    EXPECT_EQ(reader->variables()[1].time->points.size(), 1u);
    EXPECT_EQ(std::get<std::vector<float>>(reader->read(1, 0).values)[3], 4);
}

TEST(OrderedReader, OfFilesThatAreOpenedOneByOneToo) {
    const auto folder = tests::freshFolder();
    std::vector<Path> paths;
    for (const int i : {0, 1, 2}) {
        const std::string lines = fmt::format(
            "type: float\ndimension: 4\nsizes: 2 2 2 2\nkinds: space space space time\n"
            "endian: little\nencoding: raw\ntimes:={} {}\n",
            30 - 10 * i, 29 - 10 * i);
        std::vector<float> values;
        for (const int step : {0, 1}) values.insert(values.end(), 8, float(10 * i + step));
        paths.push_back(folder / fmt::format("a_{}.nrrd", i));
        tests::writeBytes(paths.back(), tests::nrrd(lines, tests::bytesOf(values)));
    }
    const auto reader = openReader(paths);
    EXPECT_THAT(timesOf(*reader), ElementsAre(9, 10, 19, 20, 29, 30));
    EXPECT_THAT(firstValues(*reader), ElementsAre(21, 20, 11, 10, 1, 0));
}

TEST(OrderedReader, WhatHasNoOrderIsTold) {
    const auto twice = tests::open(series("a.nc", std::vector{1.0, 3.0, 2.0, 3.0}, "s"));
    EXPECT_THAT(timesOf(*twice), ElementsAre(1, 3, 2, 3));
    EXPECT_THAT(firstValues(*twice), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(twice->variables()[0].notes,
                Contains("steps are as the file has them, not in order of time: steps 1 and 3 "
                         "both have 3"));
    const auto none = tests::open(series("b.nc", std::vector{1.0, std::nan(""), 2.0}, "s"));
    EXPECT_THAT(firstValues(*none), ElementsAre(0, 1, 2));
    EXPECT_THAT(none->variables()[0].notes, Contains(HasSubstr("step 1 has none")));
}

}  // namespace
}  // namespace timeseries::ordered_reader
