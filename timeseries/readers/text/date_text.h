// Moments as texts of one form state them, whatever program wrote them.
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

// "YYYY-MM-DD" alone, or with "hh:mm:ss[.f]" after '_' (WRF), 'T' or a blank, and a 'Z' behind it;
// of a fraction no more than nine digits count. Nothing where it is no such text, or the calendar
// has no such day.
std::optional<Moment> momentOfText(std::string_view text, Calendar calendar);

// "2000-02-28 23:00:00", of what momentOfText() reads, without its fraction.
std::string dateOfText(std::string_view text);

}  // namespace timeseries
