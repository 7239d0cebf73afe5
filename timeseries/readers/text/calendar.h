// The calendars of the CF conventions (1.10, section 4.4.1) in integer days: udunits knows only the
// mixed calendar, and counts its year 0 as year 1.
//
// Years are astronomical in every calendar here: year 0 exists and -1 comes before it. The mixed
// and the Julian calendar of CF, as udunits', have no year 0: what files write as -1 is the one
// before
// 1. Files that use a year 0 all the same (climatologies) mean that one, too, and expect to see it.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace timeseries {

enum class Calendar {
    Standard,  // Julian to 1582-10-04, Gregorian from 1582-10-15
    ProlepticGregorian,
    Julian,
    NoLeap,
    AllLeap,
    Day360,
};

// CF names and their synonyms, in any case; "" is standard, CF's default. Nothing for "none" and
// for calendars that have no dates here ("utc", those described by month_lengths).
std::optional<Calendar> calendarFromName(std::string_view name);
std::string_view calendarName(Calendar calendar);

struct CivilDate {
    std::int64_t year = 0;
    int month = 1, day = 1;
    friend bool operator==(const CivilDate&, const CivilDate&) = default;
};

// Of a year as files of this calendar write it, and back, in one that `hasZero` all the same.
std::int64_t yearAsWritten(Calendar calendar, std::int64_t written);
std::int64_t writtenYear(Calendar calendar, std::int64_t year, bool hasZero = false);

bool exists(Calendar calendar, const CivilDate& date);
// Days on a line without gaps. Zero is 1970-01-01 Gregorian for the first three calendars (which so
// share one line) and 0000-01-01 for the others.
// REQUIRES: exists(calendar, date), |year| <= kMaxYear.
std::int64_t dayNumber(Calendar calendar, const CivilDate& date);
// REQUIRES: |day| <= 366 kMaxYear.
CivilDate civilDate(Calendar calendar, std::int64_t day);
inline constexpr std::int64_t kMaxYear = 1'000'000'000'000;

}  // namespace timeseries
