#include "timeseries/readers/text/calendar.h"

#include <array>
#include <cassert>
#include <string>

namespace timeseries {
namespace {

std::int64_t floorDiv(std::int64_t a, std::int64_t b) {
    return a / b - ((a % b != 0) && ((a < 0) != (b < 0)));
}
std::int64_t floorMod(std::int64_t a, std::int64_t b) { return a - b * floorDiv(a, b); }

bool leap(Calendar calendar, std::int64_t year) {
    switch (calendar) {
        case Calendar::AllLeap:
            return true;
        case Calendar::NoLeap:
        case Calendar::Day360:
            return false;
        case Calendar::Julian:
            return floorMod(year, 4) == 0;
        case Calendar::Standard:
            if (year < 1582) return floorMod(year, 4) == 0;
            [[fallthrough]];
        case Calendar::ProlepticGregorian:
            return floorMod(year, 4) == 0 && (floorMod(year, 100) != 0 || floorMod(year, 400) == 0);
    }
    return false;
}

int daysInMonth(Calendar calendar, std::int64_t year, int month) {
    static constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    if (calendar == Calendar::Day360) return 30;
    return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && leap(calendar, year));
}

// Day of the year, from 0, in calendars of real months.
int dayOfYear(Calendar calendar, const CivilDate& date) {
    int days = date.day - 1;
    for (int m = 1; m < date.month; ++m) days += daysInMonth(calendar, date.year, m);
    return days;
}

// The day number of January 1st in calendars with one leap rule.
std::int64_t newYear(Calendar calendar, std::int64_t year) {
    const std::int64_t before = year - 1;  // leap days fall at the end of the years up to this one
    switch (calendar) {
        case Calendar::NoLeap:
            return 365 * year;
        case Calendar::AllLeap:
            return 366 * year;
        case Calendar::Day360:
            return 360 * year;
        case Calendar::Julian:
            // 0001-01-01 Julian is two days before 0001-01-01 Gregorian.
            return 365 * before + floorDiv(before, 4) - 719164;
        case Calendar::Standard:
        case Calendar::ProlepticGregorian:
            // 719162 Gregorian days lie between 0001-01-01 and 1970-01-01.
            return 365 * before + floorDiv(before, 4) - floorDiv(before, 100) +
                   floorDiv(before, 400) - 719162;
    }
    return 0;
}

// The rule in force on the date or on the day number.
constexpr std::int64_t kFirstGregorianDay = -141427;  // 1582-10-15
Calendar ruleOf(Calendar calendar, const CivilDate& d) {
    if (calendar != Calendar::Standard) return calendar;
    const bool gregorian =
        d.year > 1582 || (d.year == 1582 && (d.month > 10 || (d.month == 10 && d.day >= 15)));
    return gregorian ? Calendar::ProlepticGregorian : Calendar::Julian;
}
Calendar ruleOf(Calendar calendar, std::int64_t day) {
    if (calendar != Calendar::Standard) return calendar;
    return day >= kFirstGregorianDay ? Calendar::ProlepticGregorian : Calendar::Julian;
}

}  // namespace

std::optional<Calendar> calendarFromName(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Calendar>, 14> kNames{{
        {"", Calendar::Standard},
        {"standard", Calendar::Standard},
        {"gregorian", Calendar::Standard},
        {"proleptic_gregorian", Calendar::ProlepticGregorian},
        {"gregorian_proleptic", Calendar::ProlepticGregorian},
        {"tai", Calendar::ProlepticGregorian},  // CF 1.12, 4.4.2: without leap seconds
        {"julian", Calendar::Julian},
        {"noleap", Calendar::NoLeap},
        {"365_day", Calendar::NoLeap},
        {"gregorian_noleap", Calendar::NoLeap},  // MPAS, as 360day
        {"all_leap", Calendar::AllLeap},
        {"366_day", Calendar::AllLeap},
        {"360_day", Calendar::Day360},
        {"360day", Calendar::Day360},
    }};
    std::string lower;
    for (const char c : name) {
        if (c == ' ' || c == '\0') continue;
        lower += (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
    }
    for (const auto& [text, calendar] : kNames)
        if (lower == text) return calendar;
    return std::nullopt;
}

std::string_view calendarName(Calendar calendar) {
    switch (calendar) {
        case Calendar::Standard:
            return "standard";
        case Calendar::ProlepticGregorian:
            return "proleptic_gregorian";
        case Calendar::Julian:
            return "julian";
        case Calendar::NoLeap:
            return "noleap";
        case Calendar::AllLeap:
            return "all_leap";
        case Calendar::Day360:
            return "360_day";
    }
    return "";
}

namespace {

bool hasNoYearZero(Calendar calendar) {
    return calendar == Calendar::Standard || calendar == Calendar::Julian;
}

}  // namespace

std::int64_t yearAsWritten(Calendar calendar, std::int64_t written) {
    return hasNoYearZero(calendar) && written < 0 ? written + 1 : written;
}

std::int64_t writtenYear(Calendar calendar, std::int64_t year, bool hasZero) {
    return hasNoYearZero(calendar) && year < (hasZero ? 0 : 1) ? year - 1 : year;
}

bool exists(Calendar calendar, const CivilDate& d) {
    if (d.year < -kMaxYear || d.year > kMaxYear || d.month < 1 || d.month > 12 || d.day < 1)
        return false;
    // The ten days that the reform of 1582 left out.
    if (calendar == Calendar::Standard && d.year == 1582 && d.month == 10 && d.day > 4 &&
        d.day < 15)
        return false;
    return d.day <= daysInMonth(calendar, d.year, d.month);
}

std::int64_t dayNumber(Calendar calendar, const CivilDate& date) {
    assert(exists(calendar, date));
    const Calendar rule = ruleOf(calendar, date);
    return newYear(rule, date.year) + dayOfYear(rule, date);
}

CivilDate civilDate(Calendar calendar, std::int64_t day) {
    const Calendar rule = ruleOf(calendar, day);
    // Start at a year that cannot be too late by more than a few, whatever the rule: the mean year
    // is between 360 and 366 days, and every rule's is known.
    const std::int64_t perCycle = rule == Calendar::ProlepticGregorian ? 146097
                                  : rule == Calendar::Julian           ? 1461 * 100
                                  : rule == Calendar::NoLeap           ? 365 * 400
                                  : rule == Calendar::AllLeap          ? 366 * 400
                                                                       : 360 * 400;
    const std::int64_t cycle = floorDiv(day - newYear(rule, 0), perCycle);
    std::int64_t rest = day - newYear(rule, 0) - cycle * perCycle;
    CivilDate date{cycle * 400 + rest / 366, 1, 1};  // at or before the year sought
    while (newYear(rule, date.year + 1) <= day) ++date.year;
    rest = day - newYear(rule, date.year);
    while (rest >= daysInMonth(rule, date.year, date.month))
        rest -= daysInMonth(rule, date.year, date.month++);
    date.day = static_cast<int>(rest) + 1;
    return date;
}

}  // namespace timeseries
