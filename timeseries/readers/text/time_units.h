// "hours since 0000-01-01" and the dates that values in such units stand for, in integer days and
// nanoseconds. udunits gives the length of the unit; the reference is read here, in its calendar.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "timeseries/index/number.h"
#include "timeseries/readers/text/calendar.h"

namespace timeseries {

// What units count from, in UTC: a day as dayNumber(), and nanoseconds of it, less than a day.
struct TimeReference {
    std::int64_t day = 0, ns = 0;
    bool hasYearZero = false;  // its year is written so
};
// Nothing when the text is no REFERENCE, as below, or no date of the calendar.
std::optional<TimeReference> referenceOf(std::string_view text, Calendar calendar);

// "UNIT since REFERENCE" in a calendar.
class TimeUnits {
 public:
    // Nothing when the text is not of that form, the unit is no time, or the reference is no date
    // of the calendar. REFERENCE is "Y-M-D", optionally a time "h[:m[:s[.f]]]" after a blank or T,
    // and a zone "Z", "UTC", "+hh", "+hh:mm" or "+hhmm". Years and months are udunits'
    // (CF 1.10, 4.4: a year is 365.242198781 days in every calendar, a month a twelfth of it).
    static std::optional<TimeUnits> parse(std::string_view text, Calendar calendar);

    // "2000-01-04 12:00:00", with ".fff" when the rounded milliseconds are not zero, or with 6 or 9
    // decimals; rounded to whole seconds when the value cannot hold a millisecond. "" for what is
    // not finite or lies beyond kMaxYear.
    std::string date(const Number& value, int decimals = 3) const;

    // A value counted in `other`, counted in these units, by way of whole nanoseconds. NaN for what
    // has no date.
    // REQUIRES: the calendars are equal.
    double convert(const Number& value, const TimeUnits& other) const;

    Calendar calendar() const { return calendar_; }

 private:
    Calendar calendar_ = Calendar::Standard;
    std::int64_t unitNs_ = 1;                          // one unit
    std::int64_t referenceDay_ = 0, referenceNs_ = 0;  // in UTC; 0 <= referenceNs_ < a day
    bool hasYearZero_ = false;                         // the reference is of it
};

// "seconds since ...", "Days Since ...": the form alone, not whether it can be read.
bool looksLikeTimeUnits(std::string_view text);

}  // namespace timeseries
