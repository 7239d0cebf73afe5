#include "timeseries/readers/text/calendar.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace timeseries {
namespace {

constexpr std::array kAll{Calendar::Standard, Calendar::ProlepticGregorian,
                          Calendar::Julian,   Calendar::NoLeap,
                          Calendar::AllLeap,  Calendar::Day360};

// The day after, by nothing but exists(): the calendar's own words, one day at a time.
CivilDate next(Calendar calendar, CivilDate d) {
    if (calendar == Calendar::Standard && d == CivilDate{1582, 10, 4}) return {1582, 10, 15};
    ++d.day;
    if (exists(calendar, d)) return d;
    d = {d.year, d.month + 1, 1};
    if (exists(calendar, d)) return d;
    return {d.year + 1, 1, 1};
}

TEST(Calendar, CountingDayByDayAgreesWithDayNumbersOverTwentyFiveCenturies) {
    for (const Calendar calendar : kAll) {
        CivilDate date{-410, 1, 1};
        std::int64_t number = dayNumber(calendar, date);
        while (date.year < 2110) {
            ASSERT_EQ(dayNumber(calendar, date), number)
                << calendarName(calendar) << ' ' << date.year << '-' << date.month << '-'
                << date.day;
            ASSERT_EQ(civilDate(calendar, number), date) << calendarName(calendar);
            date = next(calendar, date);
            ++number;
        }
    }
}

TEST(Calendar, RandomDaysFarAwayComeBack) {
    std::mt19937_64 random(7);
    std::uniform_int_distribution<std::int64_t> days(-360 * kMaxYear, 360 * kMaxYear);
    for (int i = 0; i < 20000; ++i)
        for (const Calendar calendar : kAll) {
            const std::int64_t day = days(random);
            const CivilDate date = civilDate(calendar, day);
            ASSERT_TRUE(exists(calendar, date)) << calendarName(calendar) << ' ' << day;
            ASSERT_EQ(dayNumber(calendar, date), day) << calendarName(calendar);
        }
}

std::int64_t yearLength(Calendar calendar, std::int64_t year) {
    return dayNumber(calendar, {year + 1, 1, 1}) - dayNumber(calendar, {year, 1, 1});
}

TEST(Calendar, YearsAreAsLongAsTheirRuleSays) {
    for (std::int64_t year = -801; year < 2400; ++year) {
        const bool fourth = year % 4 == 0;
        const bool gregorian = fourth && (year % 100 != 0 || year % 400 == 0);
        EXPECT_EQ(yearLength(Calendar::NoLeap, year), 365);
        EXPECT_EQ(yearLength(Calendar::AllLeap, year), 366);
        EXPECT_EQ(yearLength(Calendar::Day360, year), 360);
        EXPECT_EQ(yearLength(Calendar::Julian, year), 365 + fourth) << year;
        EXPECT_EQ(yearLength(Calendar::ProlepticGregorian, year), 365 + gregorian) << year;
        const int mixed = year < 1582 ? 365 + fourth : year == 1582 ? 355 : 365 + gregorian;
        EXPECT_EQ(yearLength(Calendar::Standard, year), mixed) << year;
    }
}

TEST(Calendar, KnownJulianDayNumbers) {
    // The Julian day number 0 is -4712-01-01 of the Julian calendar, 2451545 is 2000-01-01
    // Gregorian and 2299161 the first Gregorian day (Meeus, Astronomical Algorithms, chapter 7).
    const std::int64_t zero = dayNumber(Calendar::Julian, {-4712, 1, 1});
    EXPECT_EQ(dayNumber(Calendar::Standard, {-4712, 1, 1}), zero);
    EXPECT_EQ(dayNumber(Calendar::Standard, {2000, 1, 1}) - zero, 2451545);
    EXPECT_EQ(dayNumber(Calendar::ProlepticGregorian, {2000, 1, 1}) - zero, 2451545);
    EXPECT_EQ(dayNumber(Calendar::Standard, {1582, 10, 15}) - zero, 2299161);
    EXPECT_EQ(dayNumber(Calendar::Standard, {1582, 10, 4}) - zero, 2299160);
    EXPECT_EQ(dayNumber(Calendar::ProlepticGregorian, {-4713, 11, 24}), zero);
    // 1970-01-01 Gregorian was 1969-12-19 for those who kept the Julian calendar.
    EXPECT_EQ(dayNumber(Calendar::Julian, {1969, 12, 19}), 0);
    EXPECT_EQ(dayNumber(Calendar::ProlepticGregorian, {1970, 1, 1}), 0);
}

TEST(Calendar, DatesThatDoNotExistAreTold) {
    EXPECT_FALSE(exists(Calendar::Standard, {1582, 10, 10}));
    EXPECT_TRUE(exists(Calendar::ProlepticGregorian, {1582, 10, 10}));
    EXPECT_TRUE(exists(Calendar::Julian, {1900, 2, 29}));
    EXPECT_FALSE(exists(Calendar::Standard, {1900, 2, 29}));
    EXPECT_TRUE(exists(Calendar::Standard, {1500, 2, 29}));
    EXPECT_TRUE(exists(Calendar::Standard, {0, 2, 29}));
    EXPECT_FALSE(exists(Calendar::NoLeap, {2000, 2, 29}));
    EXPECT_TRUE(exists(Calendar::AllLeap, {1999, 2, 29}));
    EXPECT_TRUE(exists(Calendar::Day360, {1999, 2, 30}));
    EXPECT_FALSE(exists(Calendar::Day360, {1999, 1, 31}));
    EXPECT_FALSE(exists(Calendar::Standard, {1999, 13, 1}));
    EXPECT_FALSE(exists(Calendar::Standard, {1999, 0, 1}));
    EXPECT_FALSE(exists(Calendar::Standard, {1999, 1, 0}));
}

TEST(Calendar, NamesAndSynonymsInAnyCase) {
    EXPECT_EQ(calendarFromName(""), Calendar::Standard);
    EXPECT_EQ(calendarFromName("Gregorian"), Calendar::Standard);
    EXPECT_EQ(calendarFromName("365_DAY"), Calendar::NoLeap);
    EXPECT_EQ(calendarFromName("366_day"), Calendar::AllLeap);
    EXPECT_EQ(calendarFromName("none"), std::nullopt);
    EXPECT_EQ(calendarFromName("aztec"), std::nullopt);
    for (const Calendar calendar : kAll)
        EXPECT_EQ(calendarFromName(calendarName(calendar)), calendar);
}

}  // namespace
}  // namespace timeseries
