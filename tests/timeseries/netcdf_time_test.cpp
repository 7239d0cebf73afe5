#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/timed_netcdf.h"
#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/netcdf/netcdf_reader.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using tests::firstValues;
using tests::ncType;
using tests::NetcdfBuilder;
using tests::open;
using tests::refusalOf;
using tests::series;
using tests::timesOf;
using Path = std::filesystem::path;

// As CDO writes them: the digits of a date.
TEST(NetcdfTime, AbsoluteTimesAreDates) {
    const std::string units = "day as %Y%m%d.%f";
    const auto reader =
        open(series("a.nc", {20981231.25, 20990101.0, 20990301.5}, units, "365_day"));
    const TimeAxis& time = *reader->variables()[0].time;
    EXPECT_EQ(time.units, "days since 2098-12-31");
    EXPECT_THAT(timesOf(*reader), ElementsAre(0.25, 1, 1 + 31 + 28 + 0.5));
    EXPECT_EQ(time.points[0].date, "2098-12-31 06:00:00");
    EXPECT_EQ(time.points[2].date, "2099-03-01 12:00:00");
    EXPECT_THAT(reader->variables()[0].notes, Each(Not(HasSubstr("time"))));
    // Several files count from days of their own.
    const std::vector<Path> two{series("b2.nc", {20000101.0}, units, "", 5),
                                series("b1.nc", {19991231.0}, units)};
    EXPECT_THAT(firstValues(*openReader(two)), ElementsAre(0, 5));
    // What is no date is a number.
    for (const double none : {20991301.0, 20990230.0, 1e300, std::nan("")}) {
        const auto as = open(series("c.nc", {20990101.0, none}, units));
        EXPECT_EQ(as->variables()[0].time->units, units);
        EXPECT_EQ(as->variables()[0].time->points[0].date, "");
    }
}

TEST(NetcdfTime, ValuesAreAsStoredWithDatesOfTheCalendar) {
    const auto reader = open(series("a.nc", {0.0, 58.0, 59.0}, "days since 2000-01-01", "NoLeap"));
    const TimeAxis& time = *reader->variables()[0].time;
    EXPECT_EQ(time.name, "time");
    EXPECT_EQ(time.units, "days since 2000-01-01");
    EXPECT_EQ(time.calendar, "noleap");
    EXPECT_EQ(time.points[1].value, 58.0);
    EXPECT_EQ(time.points[1].date, "2000-02-28 00:00:00");
    EXPECT_EQ(time.points[2].date, "2000-03-01 00:00:00");
    // What has no time has one step.
    EXPECT_EQ(reader->variables()[1].time->points.size(), 1u);
    EXPECT_EQ(reader->variables()[1].time->name, "step");
}

TEST(NetcdfTime, DatesHaveTheDigitsThatTellThemApart) {
    const std::string units = "seconds since 2000-01-01";
    const auto datesOf = [&](const std::vector<double>& values) {
        const auto reader = open(series("a.nc", values, units));
        std::vector<std::string> dates;
        for (const timeseries::TimePoint& point : reader->variables()[0].time->points)
            dates.push_back(point.date);
        return dates;
    };
    EXPECT_THAT(datesOf({0, 1e-4, 2e-4}),
                ElementsAre("2000-01-01 00:00:00", "2000-01-01 00:00:00.000100",
                            "2000-01-01 00:00:00.000200"));
    EXPECT_THAT(datesOf({1, 1 + 2e-8}),
                ElementsAre("2000-01-01 00:00:01", "2000-01-01 00:00:01.000000020"));
    EXPECT_THAT(datesOf({1 / 3.0, 2 / 3.0}),
                ElementsAre("2000-01-01 00:00:00.333", "2000-01-01 00:00:00.667"));
    EXPECT_THAT(datesOf({5, 5}), ElementsAre("2000-01-01 00:00:05", "2000-01-01 00:00:05"));
}

TEST(NetcdfTime, PlainNumbersHaveNoDates) {
    for (const char* units : {"", "s", "1"}) {
        const auto reader = open(series("a.nc", {0.5, 0.25}, units));
        const TimeAxis& time = *reader->variables()[0].time;
        EXPECT_THAT(timesOf(*reader), ElementsAre(0.25, 0.5)) << "ascending";
        EXPECT_EQ(time.calendar, "");
        EXPECT_EQ(time.points[0].date, "");
        EXPECT_EQ(time.units, units);
        EXPECT_THAT(reader->variables()[0].notes, Each(Not(HasSubstr("shown as numbers"))));
    }
    const auto none = open(series("b.nc", {0.5}, "days since 2000-01-01", "none"));
    EXPECT_EQ(none->variables()[0].time->points[0].date, "");
    EXPECT_EQ(none->variables()[0].time->calendar, "");
    EXPECT_THAT(none->variables()[0].notes, Each(Not(HasSubstr("shown as numbers"))));
}

TEST(NetcdfTime, DatesThatCannotBeToldAreNoted) {
    const auto bad = open(series("a.nc", {1.0}, "days since the flood"));
    EXPECT_EQ(bad->variables()[0].time->points[0].date, "");
    EXPECT_THAT(bad->variables()[0].notes,
                testing::Contains(HasSubstr("\"days since the flood\" is no date")));
    const auto odd = open(series("b.nc", {1.0}, "days since 2000-01-01", "aztec"));
    EXPECT_THAT(odd->variables()[0].notes, testing::Contains(HasSubstr("\"aztec\" is not known")));
}

TEST(NetcdfTime, SixtyFourBitTimesHaveExactDates) {
    // As a double it would be another.
    const std::int64_t ns = 1'152'921'504'607'499'999;
    ASSERT_GT(static_cast<std::int64_t>(static_cast<double>(ns)), ns + 1);
    const auto reader = open(series<std::int64_t>("a.nc", {ns}, "nanoseconds since 1970-01-01"));
    EXPECT_EQ(reader->variables()[0].time->points[0].date, "2006-07-14 23:58:24.607499999");
}

TEST(NetcdfTime, AScalarCoordinateTellsTheTimeOfASingleStep) {
    NetcdfBuilder file("a.nc");
    const int y = file.dimension("y", 2), x = file.dimension("x", 2);
    const int time = file.variable("when", NC_INT, {});
    file.text(time, "units", "hours since 2001-02-03");
    const int v = file.variable("v", NC_FLOAT, {y, x});
    file.text(v, "coordinates", "when");
    file.write(time, std::vector<std::int32_t>{30});
    const auto reader = open(file.close());
    const TimeAxis& axis = *reader->variables()[0].time;
    EXPECT_EQ(axis.name, "when");
    ASSERT_EQ(axis.points.size(), 1u);
    EXPECT_EQ(axis.points[0].date, "2001-02-04 06:00:00");
}

TEST(NetcdfTime, PackedTimesAreUnpackedAndMissingOnesAreNone) {
    NetcdfBuilder file("a.nc");
    const int t = file.dimension("time", 3), y = file.dimension("y", 2), x = file.dimension("x", 2);
    const int time = file.variable("time", NC_SHORT, {t});
    file.text(time, "units", "hours since 2001-02-03");
    file.number(time, "scale_factor", 0.5);
    file.number(time, "add_offset", 3.0);
    file.number(time, "_FillValue", std::int16_t{-1});
    const int v = file.variable("v", NC_FLOAT, {t, y, x});
    file.write(time, std::vector<std::int16_t>{0, -1, 5});
    file.write(v, std::vector<float>{6, 6, 6, 6, 7, 7, 7, 7, 8, 8, 8, 8});
    const auto reader = open(file.close());
    const auto& points = reader->variables()[0].time->points;
    EXPECT_EQ(points[0].value, 3);
    EXPECT_EQ(points[0].date, "2001-02-03 03:00:00");
    EXPECT_TRUE(std::isnan(points[1].value));
    EXPECT_EQ(points[1].date, "");
    EXPECT_EQ(points[2].value, 5.5);
    EXPECT_THAT(firstValues(*reader), ElementsAre(6, 7, 8));
}

// Of the coordinates that are named: one is not there, one is no time, two have two values.
TEST(NetcdfTime, AScalarCoordinateIsTheTimeOnlyIfItIsOneTime) {
    NetcdfBuilder file("a.nc");
    const int y = file.dimension("y", 2), x = file.dimension("x", 2),
              one = file.dimension("one", 1), two = file.dimension("two", 2);
    const int height = file.variable("height", NC_DOUBLE, {});
    file.text(height, "units", "m");
    const int many = file.variable("many", NC_DOUBLE, {one, two});
    file.text(many, "units", "hours since 1999-01-01");
    const int time = file.variable("when", NC_DOUBLE, {one});
    file.text(time, "units", "hours since 2001-02-03");
    const int v = file.variable("v", NC_FLOAT, {y, x});
    const int pair = file.variable("pair", NC_DOUBLE, {two});
    file.text(pair, "units", "hours since 1998-01-01");
    file.text(v, "coordinates", "nowhere height many pair when");
    file.write(time, std::vector<double>{30});
    const auto reader = open(file.close());
    const auto found = std::ranges::find(reader->variables(), "v", &Variable::name);
    ASSERT_NE(found, reader->variables().end());
    const TimeAxis& axis = *found->time;
    EXPECT_EQ(axis.name, "when");
    ASSERT_EQ(axis.points.size(), 1u);
    EXPECT_EQ(axis.points[0].date, "2001-02-04 06:00:00");
}

TEST(NetcdfTime, FilesOfOneTimedStepEachAreASeries) {
    const auto step = [](const std::string& name, double hours, float value) {
        NetcdfBuilder file(name);
        const int y = file.dimension("y", 2), x = file.dimension("x", 2);
        const int time = file.variable("time", NC_DOUBLE, {});
        file.text(time, "units", "hours since 2001-02-03");
        const int v = file.variable("v", NC_FLOAT, {y, x});
        file.text(v, "coordinates", "time");
        file.write(time, std::vector<double>{hours});
        file.write(v, std::vector<float>(4, value));
        return file.close();
    };
    const auto reader = openReader(std::vector<Path>{step("b.nc", 5, 50), step("a.nc", 2, 20)});
    EXPECT_THAT(timesOf(*reader), ElementsAre(2, 5));
    EXPECT_THAT(firstValues(*reader), ElementsAre(20, 50));
}

TEST(NetcdfTime, FilesAreJoinedInTheOrderOfTheirTimes) {
    const std::vector<Path> paths{series("c.nc", {6.0, 7.0}, "s", "", 60),
                                  series("a.nc", {1.0, 3.0}, "s", "", 10),
                                  series("b.nc", {4.0}, "s", "", 40)};
    const auto reader = openReader(paths);
    EXPECT_THAT(timesOf(*reader), ElementsAre(1, 3, 4, 6, 7));
    EXPECT_THAT(firstValues(*reader), ElementsAre(10, 11, 40, 60, 61));
    EXPECT_EQ(reader->read(0, 4).grid, reader->variables()[0].grid);
    EXPECT_EQ(reader->files().size(), 3u);
    EXPECT_EQ(reader->files()[0], paths[0]);
    EXPECT_EQ(reader->variables()[1].time->points.size(), 1u) << "orography has no time";
}

TEST(NetcdfTime, ReferencesOfLaterFilesAreConvertedToTheFirst) {
    // 2000 is a leap year: February has 29 days, in every file's own units.
    const std::vector<Path> paths{series("a.nc", {0.0, 24.0}, "hours since 2000-02-01"),
                                  series("b.nc", {0.0, 1.5}, "days since 2000-03-01"),
                                  series("c.nc", {3600.0}, "seconds since 2000-04-01 00:00 -1:00")};
    const auto reader = openReader(paths);
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 24, 29 * 24, 29 * 24 + 36, (29 + 31) * 24 + 2));
    EXPECT_EQ(reader->variables()[0].time->points[4].date, "2000-04-01 02:00:00");
    EXPECT_EQ(reader->variables()[0].time->units, "hours since 2000-02-01");
}

TEST(NetcdfTime, OverlappingTimesAreRefusedNamingBothFiles) {
    const Path a = series("a.nc", {0.0, 2.0}, "s"), b = series("b.nc", {1.0, 3.0}, "s"),
               c = series("c.nc", {2.0}, "s");
    EXPECT_THAT(refusalOf({b, a}), AllOf(HasSubstr(a.string()), HasSubstr(b.string()),
                                         HasSubstr("expected times that do not overlap")));
    EXPECT_THAT(refusalOf({a, c}), HasSubstr("do not overlap")) << "the same time twice";
    EXPECT_THAT(refusalOf({a, a}), HasSubstr("do not overlap")) << "the same file twice";
    const Path d = series("d.nc", {1000.0, 3000.0}, "ms"), e = series("e.nc", {-9.0}, "s");
    EXPECT_EQ(refusalOf({a, d, e}), a.string() + " and " + d.string() +
                                        ": variable 'v': expected times that do not overlap, found "
                                        "0 to 2 and 1 to 3 (s)");
}

TEST(NetcdfTime, UnitsThatCannotMeetAreRefused) {
    const Path a = series("a.nc", {0.0}, "s"), b = series("b.nc", {1.0}, "m"),
               c = series("c.nc", {5.0}, "days since 2000-01-01"),
               d = series("d.nc", {9.0}, "days since 2000-01-01", "noleap"),
               e = series("e.nc", {2.0}, "ms");
    const auto sentence = [](const Path& one, const Path& other, const char* found) {
        return one.string() + " and " + other.string() +
               ": variable 'v': expected times in units that agree, found " + found;
    };
    EXPECT_EQ(refusalOf({a, b}), sentence(a, b, "\"s\" () and \"m\" ()"));
    EXPECT_EQ(refusalOf({a, e, c}), sentence(a, c, "\"s\" () and \"days since 2000-01-01\" ()"));
    EXPECT_EQ(refusalOf({d, c}), sentence(d, c,
                                          "\"days since 2000-01-01\" (noleap) and \"days since "
                                          "2000-01-01\" ()"));
    EXPECT_THAT(timesOf(*openReader(std::vector<Path>{a, e})), ElementsAre(0, 0.002));
}

TEST(NetcdfTime, UnitsThatNobodyKnowsMeetTheirLike) {
    const char* const flood = "days since the flood";
    EXPECT_THAT(timesOf(*openReader(
                    std::vector<Path>{series("a.nc", {1.0}, flood), series("b.nc", {2.5}, flood)})),
                ElementsAre(1, 2.5));
    const Path a = series("a.nc", {1.0}, flood), b = series("b.nc", {2.5}, "days since 2000-1-1");
    EXPECT_THAT(refusalOf({a, b}), HasSubstr("expected times in units that agree"));
    EXPECT_THAT(refusalOf({b, a}), HasSubstr("expected times in units that agree"));
}

// Steps that are counted are none of another file's times, though these have no units either.
TEST(NetcdfTime, CountedStepsDoNotContinueTimes) {
    NetcdfBuilder file("b.nc");
    const int t = file.dimension("time", 3), y = file.dimension("y", 2), x = file.dimension("x", 2);
    file.variable("v", NC_FLOAT, {t, y, x});
    file.variable("orography", NC_FLOAT, {y, x});
    const Path counted = file.close(), timed = series("a.nc", {-1.0}, "");
    EXPECT_THAT(refusalOf({timed, counted}), HasSubstr("expected times in units that agree"));
    EXPECT_THAT(refusalOf({counted, timed}), HasSubstr("expected times in units that agree"));
}

// Only dates need a calendar.
TEST(NetcdfTime, CalendarsOfPlainNumbersNeedNotAgree) {
    for (const char* units : {"s", "bananas"})
        EXPECT_THAT(timesOf(*openReader(std::vector<Path>{series("a.nc", {1.0}, units, "noleap"),
                                                          series("b.nc", {2.5}, units, "none")})),
                    ElementsAre(1, 2.5));
}

TEST(NetcdfTime, FilesWithAStepWithoutATimeAreNotJoined) {
    const Path a = series("a.nc", {1.0}, "s"), b = series("b.nc", {2.0, std::nan("")}, "s");
    EXPECT_THAT(refusalOf({a, b}), AllOf(HasSubstr(a.string() + " and " + b.string()),
                                         HasSubstr("expected finite times")));
}

TEST(NetcdfTime, MoreStepsThanAnySeriesHasAreRefused) {
    NetcdfBuilder file("a.nc");
    const int t = file.dimension("time", 10'000'001), y = file.dimension("y", 2),
              x = file.dimension("x", 2);
    const int v = file.variable("v", NC_BYTE, {t, y, x});
    const std::array<std::size_t, 3> chunk{4096, 2, 2};  // nothing of them is written
    NetcdfBuilder::check(nc_def_var_chunking(file.id(), v, NC_CHUNKED, chunk.data()));
    EXPECT_THAT(refusalOf({file.close()}),
                HasSubstr("dimension 'time': expected at most 10000000 steps, found 10000001"));
}

Path still(const std::string& name, std::size_t nx, const std::string& units, nc_type type,
           float value) {
    NetcdfBuilder file(name);
    const int y = file.dimension("y", 2), x = file.dimension("x", nx);
    const int v = file.variable("v", type, {y, x});
    file.text(v, "units", units);
    file.end();
    NetcdfBuilder::check(nc_put_var_float(file.id(), v, std::vector<float>(2 * nx, value).data()));
    return file.close();
}

TEST(NetcdfTime, FilesWithoutTimeAreStepsInTheOrderGiven) {
    const std::vector<Path> paths{still("b.nc", 2, "K", NC_FLOAT, 5),
                                  still("a.nc", 2, "K", NC_FLOAT, 3)};
    const auto reader = openReader(paths);
    EXPECT_EQ(reader->variables()[0].time->name, "step");
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 1));
    EXPECT_THAT(firstValues(*reader), ElementsAre(5, 3));
}

TEST(NetcdfTime, FilesWithoutTimeAreNumberedByTheirNamesIfEachIsOneStep) {
    const std::vector<Path> stills{still("v2.nc", 2, "K", NC_FLOAT, 5),
                                   still("v10.nc", 2, "K", NC_FLOAT, 3)};
    const auto numbered = openReader(stills);
    EXPECT_EQ(numbered->variables()[0].time->name, "number");
    EXPECT_FALSE(numbered->variables()[0].time->counted);
    EXPECT_THAT(timesOf(*numbered), ElementsAre(2, 10));
    EXPECT_THAT(firstValues(*numbered), ElementsAre(5, 3));

    const auto steps = [](const std::string& name, std::size_t count) {
        NetcdfBuilder file(name);
        const int t = file.dimension("time", count), y = file.dimension("y", 2),
                  x = file.dimension("x", 2);
        file.variable("v", NC_FLOAT, {t, y, x});
        return file.close();
    };
    const auto counted = openReader(std::vector<Path>{steps("w2.nc", 3), steps("w10.nc", 2)});
    EXPECT_EQ(counted->variables()[0].time->name, "step");
    EXPECT_TRUE(counted->variables()[0].time->counted);
    EXPECT_THAT(timesOf(*counted), ElementsAre(0, 1, 2, 3, 4));
}

TEST(NetcdfTime, FilesThatDifferAreRefusedNamingBoth) {
    const Path a = still("a.nc", 2, "K", NC_FLOAT, 1), grid = still("b.nc", 3, "K", NC_FLOAT, 1),
               units = still("c.nc", 2, "degC", NC_FLOAT, 1),
               type = still("d.nc", 2, "K", NC_SHORT, 1);
    EXPECT_THAT(refusalOf({a, grid}),
                AllOf(HasSubstr(a.string() + " and " + grid.string()), HasSubstr("the same grid")));
    EXPECT_THAT(refusalOf({a, units}), HasSubstr("the same units, found \"K\" and \"degC\""));
    EXPECT_THAT(refusalOf({a, type}), HasSubstr("the same type, found float32 and int16"));
    const Path other = series("e.nc", {1.0}, "s");  // holds orography too
    EXPECT_THAT(refusalOf({other, a}),
                HasSubstr("expected the same variables, found 'orography' and 'none'"));
}

// For each step that is played from the store it is asked.
TEST(NetcdfTime, WhatStepsComeFromIsToldWithoutOpeningTheirFiles) {
    const std::vector<Path> paths{series("a.nc", {0.0, 1.0}, "s"), series("b.nc", {2.0}, "s")};
    const auto openFile = [](const Path& path) {
        return std::make_unique<NetcdfFile>(path, NetcdfFile::Header::Known);
    };
    int opened = 0;
    const auto reader = openCf(paths, openFile(paths[0]), [&](const Path& path, bool) {
        ++opened;
        return openFile(path);
    });
    opened = 0;
    for (const auto& [step, file, own] :
         {std::array<std::size_t, 3>{0, 0, 0}, {2, 1, 0}, {1, 0, 1}}) {
        const StepSources from = reader->sources(0, step);
        EXPECT_THAT(from.files, ElementsAre(paths[file]));
        EXPECT_EQ(from.step, own);
    }
    EXPECT_EQ(opened, 0);
}

}  // namespace
}  // namespace timeseries
