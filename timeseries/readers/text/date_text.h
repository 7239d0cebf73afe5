// Moments as texts state them, whatever program wrote them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "timeseries/readers/text/calendar.h"

namespace timeseries {

struct Moment {
    std::int64_t day = 0;          // as dayNumber()
    std::int64_t second = 0;       // of the day
    std::int64_t nanoseconds = 0;  // beyond it
};

// "YYYY-MM-DD" alone, or with "hh:mm[:ss[.f]]" after '_' (WRF), 'T' or a blank, and behind it a
// 'Z', "UTC" or an offset ("+01:00", "-0630", "+01"); or in ISO 8601's basic format, "YYYYMMDD" and
// "hhmm[ss[.f]]". Of a fraction no more than nine digits count. In UTC. Nothing where it is no such
// text, or the calendar has no such day.
std::optional<Moment> momentOfText(std::string_view text, Calendar calendar);

// "2000-02-28 23:00:00", and its offset, of what momentOfText() reads, without its fraction.
std::string dateOfText(std::string_view text);

}  // namespace timeseries
