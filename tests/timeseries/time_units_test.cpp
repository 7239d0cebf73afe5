#include "timeseries/readers/text/time_units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "timeseries/readers/text/date_text.h"

namespace timeseries {
namespace {

std::string date(std::string_view units, const Number& value,
                 Calendar calendar = Calendar::Standard) {
    const auto parsed = TimeUnits::parse(units, calendar);
    return parsed ? parsed->date(value) : "not understood";
}

TEST(TimeUnits, HoursOfAClimatologyStayInYearZero) {
    // 366 h are 15 days and 6 hours; year 0 is a Julian leap year, so day 59 is February 29th.
    EXPECT_EQ(date("hours since 0000-01-01 00:00:00", 366.0), "0000-01-16 06:00:00");
    EXPECT_EQ(date("days since 0000-01-01", 59.0), "0000-02-29 00:00:00");
    EXPECT_EQ(date("days since 0000-01-01", 366.0), "0001-01-01 00:00:00");
    EXPECT_EQ(date("days since 0000-01-01", -1.0), "-0002-12-31 00:00:00");
}

// Of the mixed and the Julian calendar, as CF and udunits have them: Julian days count from 4713
// BC.
TEST(TimeUnits, TheYearBefore1IsMinus1WhereThereIsNoYear0) {
    EXPECT_EQ(date("days since -4713-01-01 12:00", 2451545.0), "2000-01-01 12:00:00");
    EXPECT_EQ(date("days since -4713-01-01 12:00", 2451545.0, Calendar::Julian),
              "1999-12-19 12:00:00");
    EXPECT_EQ(date("days since -1-12-31", 1.0), "0001-01-01 00:00:00");
    EXPECT_EQ(date("days since -4713-01-01", 0.0), "-4713-01-01 00:00:00");
    EXPECT_EQ(date("days since 0001-01-01", -1.0), "-0001-12-31 00:00:00");
    EXPECT_EQ(date("days since -0001-12-31", -365.0), "-0001-01-01 00:00:00") << "1 BC was leap";
    EXPECT_EQ(date("days since -0001-12-31", -366.0), "-0002-12-31 00:00:00");
    for (const Calendar calendar : {Calendar::ProlepticGregorian, Calendar::NoLeap}) {
        EXPECT_EQ(date("days since 0001-01-01", -1.0, calendar), "0000-12-31 00:00:00");
        EXPECT_EQ(date("days since -1-12-31", 1.0, calendar), "0000-01-01 00:00:00");
    }
}

// In the seconds from 1970 of the mixed calendar; -1 for what is no date.
double secondsOfText(std::string_view text, Calendar calendar = Calendar::Standard) {
    const auto moment = momentOfText(text, calendar);
    if (!moment) return -1;
    return static_cast<double>(moment->day * 86400 + moment->second) +
           1e-9 * static_cast<double>(moment->nanoseconds);
}

TEST(DateText, DatesAreReadAsProgramsWriteThem) {
    EXPECT_EQ(secondsOfText("1970-01-02"), 86400);
    for (const char* text : {"1970-01-02_01:02:03", "1970-01-02T01:02:03", "1970-01-02 01:02:03Z"})
        EXPECT_EQ(secondsOfText(text), 86400 + 3723) << text;
    EXPECT_EQ(secondsOfText("1970-01-01_00:00:00.5"), 0.5);
    EXPECT_EQ(momentOfText("1970-01-01T00:00:00.123456789123Z", Calendar::Standard)->nanoseconds,
              123'456'789);
    EXPECT_EQ(dateOfText("1970-01-02_01:02:03.5"), "1970-01-02 01:02:03");
    EXPECT_EQ(dateOfText("1970-01-02"), "1970-01-02 00:00:00");
    for (const char* text : {"1970-01-02T01:02", "1970-01-02 01:02Z", "1970-01-02 01:02 UTC",
                             "1970-01-02T02:02+01:00", "1970-01-01T19:32:00-0530",
                             "1970-01-02 00:02:00 -01", "19700102T0102", "19700102T010200.0Z"})
        EXPECT_EQ(secondsOfText(text), 86400 + 3720) << text;
    EXPECT_EQ(secondsOfText("19700102"), 86400);
    EXPECT_EQ(dateOfText("19700102T010203.5"), "1970-01-02 01:02:03");
    // What is counted from such a date is counted from its moment.
    EXPECT_EQ(date(("seconds since " + dateOfText("1970-01-02T02:02+01:00")).c_str(), 60.0),
              "1970-01-02 01:03:00");
}

TEST(DateText, NothingElseIsRead) {
    for (const char* text : {"",
                             "1970",
                             "1970-1-2",
                             "197001",
                             "1970-01",
                             "19701302",
                             "1970-01-02Z",
                             "1970-01-02_",
                             "1970-01-02_01",
                             "1970-01-02_0102",
                             "19700102T01:02",
                             "1970-01-02_01:02:",
                             "1970-01-02_01:02.5",
                             "1970-01-02_01:02+1",
                             "1970-01-02_01:02+25:00",
                             "1970-01-02_01:02 Z",
                             "1970-01-02_01:02 CET",
                             "1970-01-02_01:02:03.",
                             "1970-01-02_01:02:03.x",
                             "1970-01-02_01:02:03 ",
                             "1970-01-02_24:00:00",
                             "1970-01-02_00:60:00",
                             "1970-01-02_00:00:60",
                             "1970-13-02",
                             "1970-00-02",
                             "1970-01-00",
                             "1970-02-29",
                             "-970-01-02",
                             "1970-01-02-01:02:03",
                             "1970-01-02_0a:00:00"})
        EXPECT_EQ(secondsOfText(text), -1) << text;
    EXPECT_EQ(secondsOfText("2000-02-29", Calendar::NoLeap), -1);
    EXPECT_NE(secondsOfText("2001-02-30", Calendar::Day360), -1);
}

TEST(TimeUnits, EachCalendarCountsItsOwnDays) {
    EXPECT_EQ(date("days since 2000-02-28", 1.0), "2000-02-29 00:00:00");
    EXPECT_EQ(date("days since 2000-02-28", 1.0, Calendar::NoLeap), "2000-03-01 00:00:00");
    EXPECT_EQ(date("days since 2001-02-28", 1.0, Calendar::AllLeap), "2001-02-29 00:00:00");
    EXPECT_EQ(date("days since 2001-02-28", 3.0, Calendar::Day360), "2001-03-01 00:00:00");
    EXPECT_EQ(date("days since 1900-02-28", 1.0, Calendar::Julian), "1900-02-29 00:00:00");
    EXPECT_EQ(date("days since 1582-10-04", 1.0), "1582-10-15 00:00:00");
    EXPECT_EQ(date("days since 1582-10-04", 1.0, Calendar::ProlepticGregorian),
              "1582-10-05 00:00:00");
    EXPECT_EQ(date("days since 0001-01-01", 360.0 * 1999, Calendar::Day360), "2000-01-01 00:00:00");
    EXPECT_EQ(date("days since 0001-01-01", 365.0 * 1999, Calendar::NoLeap), "2000-01-01 00:00:00");
}

TEST(TimeUnits, FractionsShowTheTimeThatWasMeant) {
    for (int tenth = 0; tenth < 240; ++tenth) {
        char expected[64];
        std::snprintf(expected, sizeof expected, "2020-01-01 %02d:%02d:00", tenth / 10,
                      tenth % 10 * 6);
        EXPECT_EQ(date("hours since 2020-01-01", 0.1 * tenth), expected) << tenth;
        EXPECT_EQ(date("days since 2020-01-01", tenth / 240.0), expected) << tenth;
        // 43829 days from 1900-01-01 to 2020-01-01: 120 years with 29 leap days.
        EXPECT_EQ(date("days since 1900-01-01", 43829 + tenth / 240.0), expected) << tenth;
    }
    EXPECT_EQ(date("s since 2020-01-01", 0.25), "2020-01-01 00:00:00.250");
    EXPECT_EQ(date("s since 2020-01-01", -0.25), "2019-12-31 23:59:59.750");
    EXPECT_EQ(date("s since 2020-01-01", 59.99999), "2020-01-01 00:01:00");
    EXPECT_EQ(date("ms since 2020-01-01", 1.0), "2020-01-01 00:00:00.001");
}

TEST(TimeUnits, IntegersBeyondTwoToThe53AreExact) {
    // A nanosecond short of a half of a millisecond. Doubles are 128 ns apart there: of those
    // microseconds are told.
    const std::int64_t ns = (std::int64_t{1'152'921'504'606'499'999});
    const double rounded = std::nextafter(static_cast<double>(ns), 2e18);
    EXPECT_EQ(date("nanoseconds since 1970-01-01", ns), "2006-07-14 23:58:24.606499999");
    EXPECT_EQ(date("nanoseconds since 1970-01-01", rounded), "2006-07-14 23:58:24.606500");
    EXPECT_EQ(date("nanoseconds since 1970-01-01", static_cast<std::uint64_t>(ns)),
              "2006-07-14 23:58:24.606499999");
}

TEST(TimeUnits, ZonesShiftTheReference) {
    EXPECT_EQ(date("hours since 1992-10-08 15:15:42.5 -6:00", 0.0), "1992-10-08 21:15:42.500");
    EXPECT_EQ(date("hours since 1992-10-08 00:15 +5:30", 0.0), "1992-10-07 18:45:00");
    EXPECT_EQ(date("hours since 1992-10-08T12:00:00Z", 1.0), "1992-10-08 13:00:00");
    EXPECT_EQ(date("hours since 1992-10-08 12:00:00 UTC", 1.0), "1992-10-08 13:00:00");
    EXPECT_EQ(date("hours since 1992-10-08 12:00:00 +0130", 0.0), "1992-10-08 10:30:00");
    EXPECT_EQ(date("hours since 1992-10-08 12:00:00 +1", 0.0), "1992-10-08 11:00:00");
}

// https://unidata.github.io/cftime/api.html: num2date's units.
TEST(TimeUnits, UnitsHaveTheNamesThatCftimeWrites) {
    EXPECT_EQ(date("hrs since 2000-01-01", 30.0), "2000-01-02 06:00:00");
    EXPECT_EQ(date("Hrs since 2000-01-01", 30.0), "2000-01-02 06:00:00");
    EXPECT_EQ(date("mins since 2000-01-01", 90.0), "2000-01-01 01:30:00");
    for (const char* unit : {"hr", "h", "hours"})
        EXPECT_EQ(date(std::string(unit) + " since 2000-01-01", 2.0), "2000-01-01 02:00:00");
    for (const char* unit : {"secs", "sec", "s"})
        EXPECT_EQ(date(std::string(unit) + " since 2000-01-01", 2.0), "2000-01-01 00:00:02");
    for (const char* unit : {"msecs", "millisecs"})
        EXPECT_EQ(date(std::string(unit) + " since 2000-01-01", 2000.0), "2000-01-01 00:00:02");
}

TEST(TimeUnits, FormsOfTheReference) {
    EXPECT_EQ(date("days since 1-1-1", 0.0), "0001-01-01 00:00:00");
    EXPECT_EQ(date("Days Since 2000-1-2 3:4:5", 0.0), "2000-01-02 03:04:05");
    EXPECT_EQ(date("days since 2000-1-2 3", 0.0), "2000-01-02 03:00:00");
    EXPECT_EQ(date("days since 2000", 0.0), "2000-01-01 00:00:00");
    EXPECT_EQ(date("  hour  since  2000-01-01 24:00:00 ", 0.0), "2000-01-02 00:00:00");
    EXPECT_EQ(date("weeks since 2000-01-01", 1.0), "2000-01-08 00:00:00");
}

// The grammar of udunits 2: years have four digits where nothing stands between them and the month.
TEST(TimeUnits, PackedReferences) {
    EXPECT_EQ(date("hours since 20000102", 0.0), "2000-01-02 00:00:00");
    EXPECT_EQ(date("hours since 200003", 1.0), "2000-03-01 01:00:00");
    EXPECT_EQ(date("hours since 20000101T0600", 0.0), "2000-01-01 06:00:00");
    EXPECT_EQ(date("hours since 20000101 123045.5", 0.0), "2000-01-01 12:30:45.500");
    EXPECT_EQ(date("hours since 2000-01-01 1230 +0100", 0.0), "2000-01-01 11:30:00");
    EXPECT_EQ(date("days since 12000-01-01", 0.0), "12000-01-01 00:00:00");
    for (const char* text : {"hours since 2000010", "hours since 20000", "hours since 20001301",
                             "hours since 2000010100", "hours since 2000-01-01 123",
                             "hours since 2000-01-01 2560", "hours since 2000-01-01 12345"})
        EXPECT_EQ(date(text, 0.0), "not understood") << text;
}

TEST(TimeUnits, ShorterThanAMillisecondAreTold) {
    EXPECT_EQ(date("microseconds since 1970-01-01", std::int64_t{0}), "1970-01-01 00:00:00");
    EXPECT_EQ(date("microseconds since 1970-01-01", 2.0), "1970-01-01 00:00:00.000002");
    EXPECT_EQ(date("nanoseconds since 1970-01-01", std::int64_t{1'000'000'003}),
              "1970-01-01 00:00:01.000000003");
    EXPECT_EQ(date("milliseconds since 1970-01-01", 7.0), "1970-01-01 00:00:00.007");
    // No digit that the value does not hold: doubles are 128 ns apart there.
    EXPECT_EQ(date("nanoseconds since 1970-01-01", 1e18), "2001-09-09 01:46:40");
    EXPECT_EQ(date("nanoseconds since 1970-01-01", 1e18 + 4096), "2001-09-09 01:46:40.000004");
}

TEST(TimeUnits, MonthsOfThirtyDaysAreTheCalendars) {
    for (const char* units :
         {"months since 2000-01-01", "month since 2000-01-01", "Months since 2000-01-01"}) {
        EXPECT_EQ(date(units, 1.0, Calendar::Day360), "2000-02-01 00:00:00");
        EXPECT_EQ(date(units, 12.0, Calendar::Day360), "2001-01-01 00:00:00");
    }
}

TEST(TimeUnits, YearsAndMonthsAreThoseOfUdunits) {
    // 365.242198781 d = 365 d 5 h 48 min 45.975 s; a twelfth is 30 d 10 h 29 min 3.831 s.
    EXPECT_EQ(date("years since 2001-01-01", 1.0), "2002-01-01 05:48:45.975");
    EXPECT_EQ(date("months since 2001-01-01", 1.0), "2001-01-31 10:29:03.831");
    EXPECT_EQ(date("months since 2001-01-01", 12.0), date("years since 2001-01-01", 1.0));
    EXPECT_EQ(date("common_years since 2001-01-01", 1.0), "2002-01-01 00:00:00");
}

TEST(TimeUnits, WhatIsNoTimeIsNotUnderstood) {
    for (const char* text :
         {"", "s", "hours", "hours since", "hours since yesterday", "K since 2000-01-01",
          "hours since 2000-13-01", "hours since 2000-02-30", "hours since 1582-10-10",
          "hours since 2000-01-01 25:00", "hours since 2000-01-01 10:61",
          "hours since 2000-01-01 10:00 MARS", "hours since 2000-01-01 10:00:00 junk",
          "since 2000-01-01", "hours since 99999999999999999-01-01", "hours since --1-01-01"})
        EXPECT_EQ(date(text, 0.0), "not understood") << text;
    EXPECT_EQ(date("days since 2001-02-29", 0.0, Calendar::NoLeap), "not understood");
}

TEST(TimeUnits, ValuesWithoutADateGiveNone) {
    EXPECT_EQ(date("days since 2000-01-01", std::nan("")), "");
    EXPECT_EQ(date("days since 2000-01-01", HUGE_VAL), "");
    EXPECT_EQ(date("days since 2000-01-01", 1e300), "");
    EXPECT_EQ(date("days since 2000-01-01", -1e18), "");
    EXPECT_EQ(date("days since 2000-01-01", 1e-300), "2000-01-01 00:00:00");
    // 9.97e36, netCDF's default fill, is no date either.
    EXPECT_EQ(date("seconds since 2000-01-01", 9.969209968386869e36), "");
}

TEST(TimeUnits, ConvertingKeepsTheInstant) {
    const auto hours = TimeUnits::parse("hours since 2000-01-01", Calendar::Standard);
    const auto days = TimeUnits::parse("days since 1999-12-30 12:00", Calendar::Standard);
    const auto old = TimeUnits::parse("seconds since 0000-01-01", Calendar::Standard);
    EXPECT_EQ(hours->convert(2.0, *days), 12.0);  // 36 h before the year, 48 h on
    EXPECT_EQ(hours->convert(0.1, *hours), 0.1);
    EXPECT_EQ(days->convert(-36.0, *hours), 0.0);
    for (const double h : {0.0, 0.1, 1.0 / 3, 17.25, 1e6, -123456.789}) {
        const double seconds = old->convert(h, *hours);
        EXPECT_NEAR(hours->convert(seconds, *old), h, 1e-5 / 3600 * 2) << h;  // ulp of 6e10 s
        EXPECT_EQ(hours->date(h), old->date(seconds)) << h;
    }
}

TEST(TimeUnits, TheFormAloneIsRecognised) {
    EXPECT_TRUE(looksLikeTimeUnits("days since the flood"));
    EXPECT_TRUE(looksLikeTimeUnits("Months since 1900-1-1"));
    EXPECT_FALSE(looksLikeTimeUnits("days"));
    EXPECT_FALSE(looksLikeTimeUnits("metres since 2000-01-01"));
    EXPECT_FALSE(looksLikeTimeUnits("since"));
}

}  // namespace
}  // namespace timeseries
