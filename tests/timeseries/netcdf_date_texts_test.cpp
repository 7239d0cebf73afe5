// Times that a NetCDF file has as texts of dates.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/timed_netcdf.h"

namespace timeseries {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using tests::firstValues;
using tests::NetcdfBuilder;
using tests::open;
using tests::refusalOf;
using tests::series;
using tests::timesOf;
using Path = std::filesystem::path;

struct NamesInFile {
    std::string times = "Times", calendar = "calendar";
};

// As WRF writes them: v(Time, y = 2, x = 2), every value of step t being first + t, and the rows as
// characters of `Times`.
Path dated(const std::string& name, const std::vector<std::string>& rows, float first = 0,
           const std::string& calendar = "", int mode = NC_NETCDF4, const NamesInFile& names = {}) {
    NetcdfBuilder file(name, mode);
    const int t = file.dimension("Time", rows.size()),
              length = file.dimension("DateStrLen", rows[0].size()), y = file.dimension("y", 2),
              x = file.dimension("x", 2);
    const int times = file.variable(names.times, NC_CHAR, {t, length});
    if (!calendar.empty()) file.text(NC_GLOBAL, names.calendar, calendar);
    const int v = file.variable("v", NC_FLOAT, {t, y, x});
    std::string all;
    std::vector<float> values;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        all += rows[i];
        values.insert(values.end(), 4, first + static_cast<float>(i));
    }
    file.writeText(times, all);
    file.write(v, values);
    return file.close();
}

// 2000 is a leap year.
TEST(NetcdfDateTexts, DatesInTextAreTimes) {
    for (const int mode : {0, NC_NETCDF4}) {
        const auto reader = open(
            dated("a.nc", {"2000-02-28_23:00:00", "2000-02-29_00:30:00", "2000-03-01_23:00:00"}, 0,
                  "", mode));
        const TimeAxis& time = *reader->variables()[0].time;
        EXPECT_EQ(time.name, "Times");
        EXPECT_EQ(time.units, "seconds since 2000-02-28 23:00:00");
        EXPECT_EQ(time.calendar, "standard");
        EXPECT_FALSE(time.counted);
        EXPECT_THAT(timesOf(*reader), ElementsAre(0, 90 * 60, 2 * 86400));
        EXPECT_EQ(time.points[0].date, "2000-02-28 23:00:00");
        EXPECT_EQ(time.points[1].date, "2000-02-29 00:30:00");
        EXPECT_EQ(time.points[2].date, "2000-03-01 23:00:00");
        EXPECT_THAT(reader->variables()[0].notes, Each(Not(HasSubstr("Times"))));
        EXPECT_THAT(firstValues(*reader), ElementsAre(0, 1, 2));
    }
}

TEST(NetcdfDateTexts, DatesInTextAreOfTheFilesCalendar) {
    const std::vector<std::string> rows{"2000-02-28_00:00:00", "2000-03-01_00:00:00"};
    const auto reader = open(dated("a.nc", rows, 0, "noleap"));
    EXPECT_EQ(reader->variables()[0].time->calendar, "noleap");
    EXPECT_EQ(reader->variables()[0].time->points[1].date, "2000-03-01 00:00:00");
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 86400));
    EXPECT_THAT(timesOf(*open(dated("b.nc", rows))), ElementsAre(0, 2 * 86400));
}

// MPAS calls them otherwise, fills 64 characters, and counts years from a model's first.
TEST(NetcdfDateTexts, DatesInTextOfMpasAreTimes) {
    const auto padded = [](std::string date) { return date + std::string(64 - date.size(), ' '); };
    const std::vector<std::string> rows{padded("0004-02-28_00:00:00"),
                                        padded("0004-03-01_00:00:00")};
    const NamesInFile names{"xtime", "config_calendar_type"};
    for (const auto& [calendar, days] :
         {std::pair("gregorian_noleap", 1), std::pair("360day", 3), std::pair("gregorian", 2)}) {
        const auto reader = open(dated("a.nc", rows, 0, calendar, 0, names));
        EXPECT_THAT(timesOf(*reader), ElementsAre(0, days * 86400)) << calendar;
        EXPECT_EQ(reader->variables()[0].time->name, "xtime");
        EXPECT_EQ(reader->variables()[0].time->points[1].date, "0004-03-01 00:00:00") << calendar;
    }
}

TEST(NetcdfDateTexts, DatesInTextMayHaveFractions) {
    const auto reader = open(dated("a.nc", {"1999-12-31T23:59:59.25", "2000-01-01T00:00:00.50"}));
    EXPECT_THAT(timesOf(*reader), ElementsAre(0.25, 1.5)) << "of the first the whole second";
    EXPECT_EQ(reader->variables()[0].time->units, "seconds since 1999-12-31 23:59:59");
    EXPECT_EQ(reader->variables()[0].time->points[1].date, "2000-01-01 00:00:00.500");
}

// In the order of their dates, in the first file's units, as other times.
TEST(NetcdfDateTexts, FilesOfDatesInTextAreJoined) {
    const Path later = dated("a.nc", {"2000-01-02_00:00:00", "2000-01-02_06:00:00"}, 10),
               first = dated("b.nc", {"2000-01-01 12:00:00"}),
               numbers = series("c.nc", {3.0, 4.0}, "days since 2000-01-01", "", 20);
    const auto reader = openReader(std::vector<Path>{later, first});
    EXPECT_THAT(timesOf(*reader), ElementsAre(-12 * 3600, 0, 6 * 3600));
    EXPECT_THAT(firstValues(*reader), ElementsAre(0, 10, 11));
    EXPECT_EQ(reader->variables()[0].time->points[0].date, "2000-01-01 12:00:00");
    EXPECT_THAT(refusalOf({later, dated("d.nc", {"2000-01-02_03:00:00"})}),
                HasSubstr("expected times that do not overlap"));
    EXPECT_THAT(refusalOf({later, dated("e.nc", {"2000-02-01_00:00:00"}, 0, "noleap")}),
                HasSubstr("expected times in units that agree"));
    EXPECT_THAT(refusalOf({first, numbers}), HasSubstr("expected the same variables"))
        << "orography, so that the times agree";
}

// WRF has both.
TEST(NetcdfDateTexts, TimesInNumbersGoBeforeThoseInText) {
    NetcdfBuilder file("a.nc");
    const int t = file.dimension("Time", 2), length = file.dimension("DateStrLen", 19),
              y = file.dimension("y", 2), x = file.dimension("x", 2);
    const int times = file.variable("Times", NC_CHAR, {t, length});
    const int minutes = file.variable("XTIME", NC_FLOAT, {t});
    file.text(minutes, "units", "minutes since 2000-01-01 00:00:00");
    const int v = file.variable("v", NC_FLOAT, {t, y, x});
    file.text(v, "coordinates", "XTIME");
    file.writeText(times, "1999-01-01_00:00:00no date at all here");
    file.write(minutes, std::vector<float>{0, 30});
    const auto reader = open(file.close());
    EXPECT_EQ(reader->variables()[0].time->name, "XTIME");
    EXPECT_EQ(reader->variables()[0].time->points[1].date, "2000-01-01 00:30:00");
    EXPECT_THAT(reader->variables()[0].notes, Each(Not(HasSubstr("Times"))));
}

TEST(NetcdfDateTexts, TextsThatAreNoDatesAreTold) {
    const std::string good = "2000-01-31_12:00:00";
    for (const std::string bad :
         {"2000-01-32_12:00:00", "2000-02-30_00:00:00", "2000-01-31_24:00:00",
          "2000-01-31x12:00:00", "2000-01-31_12:00:0 ", "                   ",
          "it is late, said he"}) {
        const auto reader = open(dated("a.nc", {good, bad}));
        const TimeAxis& time = *reader->variables()[0].time;
        EXPECT_TRUE(time.counted) << bad;
        EXPECT_EQ(time.name, "step");
        EXPECT_THAT(timesOf(*reader), ElementsAre(0, 1));
        const std::string told = bad.substr(0, bad.find_last_not_of(' ') + 1);
        EXPECT_THAT(reader->variables()[0].notes,
                    testing::Contains("Times is not read, steps are counted: expected dates such "
                                      "as 2000-01-31_12:00:00, found \"" +
                                      told + "\""));
    }
    EXPECT_THAT(open(dated("b.nc", {good}, 0, "aztec"))->variables()[0].notes,
                testing::Contains(HasSubstr("the calendar \"aztec\" is not known")));
    const std::string odd =
        "a\nb\x01" + std::string(60, 'c');  // the first 40 are told, on one line
    EXPECT_THAT(open(dated("c.nc", {odd}))->variables()[0].notes,
                testing::Contains(HasSubstr("found \"a?b?" + std::string(36, 'c') + "...\"")));
    EXPECT_THAT(open(dated("d.nc", {good + std::string(300, ' ')}))->variables()[0].notes,
                testing::Contains(HasSubstr("found rows of 319 characters")));
}

// One of them has none: then no file's are taken.
TEST(NetcdfDateTexts, FilesOfWhichOnesTextsAreNoDatesAreCounted) {
    const Path a = dated("a.nc", {"2000-01-02_00:00:00", "2000-01-03_00:00:00"}, 10),
               bad = dated("b.nc", {"????"}, 5);
    const auto reader = openReader(std::vector<Path>{a, bad});
    EXPECT_TRUE(reader->variables()[0].time->counted);
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 1, 2));
    EXPECT_THAT(firstValues(*reader), ElementsAre(10, 11, 5)) << "the order given";
    EXPECT_THAT(reader->variables()[0].notes,
                testing::Contains(AllOf(HasSubstr("b.nc: Times is not read, steps are counted"),
                                        HasSubstr("found \"????\""))));
    NetcdfBuilder file("c.nc");
    const int t = file.dimension("Time", 1), y = file.dimension("y", 2), x = file.dimension("x", 2);
    file.write(file.variable("v", NC_FLOAT, {t, y, x}), std::vector<float>(4, 7));
    const auto without = openReader(std::vector<Path>{a, file.close()});
    EXPECT_THAT(timesOf(*without), ElementsAre(0, 1, 2));
    EXPECT_THAT(without->variables()[0].notes,
                testing::Contains("Times of a.nc is not read, steps are counted: c.nc has no such "
                                  "dates"));
}

// As xarray and others write them where nobody asks for numbers.
Path withStrings(const std::string& name, std::vector<const char*> rows) {
    NetcdfBuilder file(name);
    const int t = file.dimension("time", rows.size()), y = file.dimension("y", 2),
              x = file.dimension("x", 2);
    const int time = file.variable("time", NC_STRING, {t});
    file.variable("v", NC_FLOAT, {t, y, x});
    file.end();
    NetcdfBuilder::check(nc_put_var_string(file.id(), time, rows.data()));
    return file.close();
}

TEST(NetcdfDateTexts, StringsThatAreDatesAreTimes) {
    const auto reader = open(
        withStrings("a.nc", {"2000-02-28", "2000-02-28T12:00:00", "2000-02-29 00:00:00.125Z"}));
    EXPECT_EQ(reader->variables()[0].time->name, "time");
    EXPECT_EQ(reader->variables()[0].time->units, "seconds since 2000-02-28 00:00:00");
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 12 * 3600, 86400.125));
    EXPECT_EQ(reader->variables()[0].time->points[2].date, "2000-02-29 00:00:00.125");
    // More than are read at a time.
    const std::vector<const char*> many(200, "2000-02-28T12:00:00");
    EXPECT_EQ(timesOf(*open(withStrings("b.nc", many))), std::vector<double>(200, 0.0));
    const std::string endless(100'000, '2');
    for (const char* none : {"yesterday", "", endless.c_str()}) {
        const auto counted = open(withStrings("c.nc", {"2000-02-28", none, "2000-02-29"}));
        EXPECT_TRUE(counted->variables()[0].time->counted);
        EXPECT_THAT(timesOf(*counted), ElementsAre(0, 1, 2));
        EXPECT_THAT(counted->variables()[0].notes,
                    testing::Contains(HasSubstr("time is not read, steps are counted")));
    }
}

}  // namespace
}  // namespace timeseries
