#include "timeseries/readers/text/time_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "timeseries/readers/text/units.h"

namespace timeseries {
namespace {

__extension__ using Wide = __int128;  // nanoseconds over kMaxYear years pass 64 bits
constexpr std::int64_t kDayNs = 86'400'000'000'000;
constexpr Wide kMaxNs = static_cast<Wide>(366) * kMaxYear * kDayNs;

// Reads a text from its front; every take leaves it untouched when it does not match.
struct Cursor {
    std::string_view rest;

    bool blank() {
        const auto before = rest.size();
        while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest[0])))
            rest.remove_prefix(1);
        return rest.size() != before;
    }
    bool take(char c) {
        if (rest.empty() || std::toupper(static_cast<unsigned char>(rest[0])) != c) return false;
        rest.remove_prefix(1);
        return true;
    }
    bool takeWord(std::string_view upper) {
        if (rest.size() < upper.size()) return false;
        for (std::size_t i = 0; i < upper.size(); ++i)
            if (std::toupper(static_cast<unsigned char>(rest[i])) != upper[i]) return false;
        rest.remove_prefix(upper.size());
        return true;
    }
    // Digits only, at most `most` of them.
    std::optional<std::int64_t> digits(std::size_t most) {
        std::size_t n = 0;
        while (n < rest.size() && std::isdigit(static_cast<unsigned char>(rest[n]))) ++n;
        if (n == 0 || n > most) return std::nullopt;
        std::int64_t value = 0;
        std::from_chars(rest.data(), rest.data() + n, value);
        rest.remove_prefix(n);
        return value;
    }
    // ".25" in nanoseconds, digits beyond the ninth dropped; 0 when there is none.
    std::int64_t fractionNs() {
        if (!take('.')) return 0;
        std::int64_t ns = 0, place = 100'000'000;
        while (!rest.empty() && std::isdigit(static_cast<unsigned char>(rest[0]))) {
            ns += place * (rest[0] - '0');
            place /= 10;
            rest.remove_prefix(1);
        }
        return ns;
    }
};

// "Y-M-D"; a month or day left out is the first, as in udunits, whose "YYYYMM" and "YYYYMMDD" are
// dates, too.
std::optional<CivilDate> takeDate(Cursor& in) {
    CivilDate date;
    const bool negative = in.take('-');
    if (!negative) in.take('+');
    const std::size_t before = in.rest.size();
    const auto year = in.digits(12);
    if (!year) return std::nullopt;
    date.year = negative ? -*year : *year;
    const std::size_t length = before - in.rest.size();
    if (length > 4 && !in.rest.starts_with('-')) {  // packed
        if (length != 6 && length != 8) return std::nullopt;
        const std::int64_t month = length == 8 ? *year / 100 : *year;
        if (length == 8) date.day = static_cast<int>(*year % 100);
        date.month = static_cast<int>(month % 100);
        date.year = (negative ? -1 : 1) * (month / 100);
        return date;
    }
    for (int* part : {&date.month, &date.day}) {
        if (!in.take('-')) break;
        const auto n = in.digits(2);
        if (!n) return std::nullopt;
        *part = static_cast<int>(*n);
    }
    return date;
}

// "h[:m[:s[.f]]]", or udunits' "hhmm[ss[.f]]", since midnight. 24:00:00 and the leap second
// 23:59:60 are told as the next day.
std::optional<std::int64_t> takeClockNs(Cursor& in) {
    const std::size_t before = in.rest.size();
    auto hour = in.digits(6);
    const std::size_t length = before - in.rest.size();
    std::optional<std::int64_t> minute = 0, second = 0;
    std::int64_t fraction = 0;
    if (length == 4 || length == 6) {
        const std::int64_t packed = length == 6 ? *hour : *hour * 100;
        hour = packed / 10'000;
        minute = packed / 100 % 100;
        second = packed % 100;
        if (length == 6) fraction = in.fractionNs();
    } else if (length > 2) {
        return std::nullopt;
    } else if (in.take(':')) {
        minute = in.digits(2);
        if (in.take(':')) {
            second = in.digits(2);
            fraction = in.fractionNs();
        }
    }
    if (!hour || !minute || !second || *minute > 59 || *second > 60) return std::nullopt;
    const std::int64_t ns = ((*hour * 60 + *minute) * 60 + *second) * 1'000'000'000 + fraction;
    if (ns > kDayNs) return std::nullopt;
    return ns;
}

// How far the zone's clock is ahead of UTC. 0 when nothing is left.
std::optional<std::int64_t> takeZoneNs(Cursor& in) {
    in.blank();
    if (in.rest.empty() || in.takeWord("UTC") || in.takeWord("GMT") || in.take('Z')) return 0;
    const bool west = in.take('-');
    if (!west) in.take('+');
    const std::size_t before = in.rest.size();
    auto hours = in.digits(4);
    std::optional<std::int64_t> minutes = 0;
    if (!hours) return std::nullopt;
    if (before - in.rest.size() > 2) {  // hhmm
        minutes = *hours % 100;
        hours = *hours / 100;
    } else if (in.take(':')) {
        minutes = in.digits(2);
    }
    if (!minutes || *minutes > 59 || *hours > 23) return std::nullopt;
    const std::int64_t ns = (*hours * 60 + *minutes) * 60'000'000'000;
    return west ? -ns : ns;
}

// The texts left and right of "since" or its synonyms in udunits.
std::optional<std::pair<std::string_view, std::string_view>> splitSince(std::string_view text) {
    for (const std::string_view word : {"SINCE", "AFTER", "FROM", "REF", "@"})
        for (std::size_t i = 1; i + word.size() < text.size(); ++i) {
            Cursor in{text.substr(i)};
            const bool starts =
                word == "@" || std::isspace(static_cast<unsigned char>(text[i - 1]));
            if (starts && in.takeWord(word) && (in.blank() || word == "@"))
                return std::pair{text.substr(0, i), in.rest};
        }
    return std::nullopt;
}

// value * unitNs, rounded to whole nanoseconds once; nothing when it passes kMaxNs.
std::optional<Wide> timesUnit(const Number& value, std::int64_t unitNs) {
    Wide product = 0;
    if (const double* d = std::get_if<double>(&value)) {
        if (!std::isfinite(*d) ||
            std::abs(*d) * static_cast<double>(unitNs) > static_cast<double>(kMaxNs))
            return std::nullopt;
        int exponent = 0;  // d = mantissa * 2^(exponent - 53), mantissa an integer
        const double fraction = std::frexp(*d, &exponent);
        product = static_cast<Wide>(std::ldexp(fraction, 53)) * unitNs;
        const int shift = 53 - exponent;
        if (shift > 126) return 0;
        if (shift > 0)
            product = (product + (static_cast<Wide>(1) << (shift - 1))) >> shift;
        else
            product *= static_cast<Wide>(1) << -shift;
    } else if (const auto* i = std::get_if<std::int64_t>(&value)) {
        product = static_cast<Wide>(*i) * unitNs;
    } else {
        product = static_cast<Wide>(std::get<std::uint64_t>(value)) * unitNs;
    }
    if (product > kMaxNs || product < -kMaxNs) return std::nullopt;
    return product;
}

// What separates the value from its neighbours, in nanoseconds.
double resolutionNs(const Number& value, std::int64_t unitNs) {
    const double* d = std::get_if<double>(&value);
    if (!d) return 0;
    const double next = std::nextafter(std::abs(*d), std::numeric_limits<double>::infinity());
    return (next - std::abs(*d)) * static_cast<double>(unitNs);
}

// A month is udunits', a twelfth of a year; where a calendar's months are all alike, one of those.
std::optional<double> secondsOf(std::string_view unit, Calendar calendar) {
    Cursor in{unit};
    in.blank();
    if (calendar == Calendar::Day360 && in.takeWord("MONTH")) {
        in.take('S');
        in.blank();
        if (in.rest.empty()) return 30 * 86400.0;
    }
    return unitRatio(std::string(unit), "s");
}

}  // namespace

bool looksLikeTimeUnits(std::string_view text) {
    const auto parts = splitSince(text);
    return parts && unitRatio(std::string(parts->first), "s").has_value();
}

std::optional<TimeReference> referenceOf(std::string_view text, Calendar calendar) {
    Cursor in{text};
    in.blank();
    auto date = takeDate(in);
    if (!date) return std::nullopt;
    const bool hasYearZero = date->year == 0;
    date->year = yearAsWritten(calendar, date->year);
    if (!exists(calendar, *date)) return std::nullopt;
    std::int64_t ns = 0;
    const bool blank = in.blank();
    if (in.take('T') ||
        (blank && !in.rest.empty() && std::isdigit(static_cast<unsigned char>(in.rest[0])))) {
        const auto clock = takeClockNs(in);
        if (!clock) return std::nullopt;
        ns = *clock;
    }
    const auto zone = takeZoneNs(in);
    in.blank();
    if (!zone || !in.rest.empty()) return std::nullopt;
    ns -= *zone;
    const std::int64_t days = ns >= 0 ? ns / kDayNs : -((kDayNs - 1 - ns) / kDayNs);
    return TimeReference{dayNumber(calendar, *date) + days, ns - days * kDayNs, hasYearZero};
}

std::optional<TimeUnits> TimeUnits::parse(std::string_view text, Calendar calendar) {
    const auto parts = splitSince(text);
    if (!parts) return std::nullopt;
    const auto seconds = secondsOf(parts->first, calendar);
    if (!seconds || !(*seconds >= 1e-9) || !(*seconds < 9e9)) return std::nullopt;

    const auto reference = referenceOf(parts->second, calendar);
    if (!reference) return std::nullopt;
    TimeUnits units;
    units.calendar_ = calendar;
    units.hasYearZero_ = reference->hasYearZero;
    units.unitNs_ = std::llround(*seconds * 1e9L);
    units.referenceDay_ = reference->day;
    units.referenceNs_ = reference->ns;
    return units;
}

std::string TimeUnits::date(const Number& value, int decimals) const {
    const auto since = timesUnit(value, unitNs_);
    if (!since) return "";
    // A value of 43831.1 days is a third of a microsecond off: the clock shows no more than the
    // value holds, and no more than it is asked for, unless their unit is shorter.
    decimals = std::max(decimals, unitNs_ < 1'000 ? 9 : unitNs_ < 1'000'000 ? 6 : 3);
    std::int64_t shown = decimals == 9 ? 1 : decimals == 6 ? 1'000 : 1'000'000;
    const double resolution = resolutionNs(value, unitNs_);
    for (; decimals > 0 && !(resolution < static_cast<double>(shown)); decimals -= 3)
        shown *= 1'000;
    Wide ns = *since + referenceNs_ + shown / 2;
    Wide days = ns / kDayNs - (ns % kDayNs < 0);
    const auto clock = static_cast<std::int64_t>(ns - days * kDayNs) / shown * shown;
    days += referenceDay_;
    CivilDate d = civilDate(calendar_, static_cast<std::int64_t>(days));
    d.year = writtenYear(calendar_, d.year, hasYearZero_);
    const std::int64_t second = clock / 1'000'000'000, fraction = clock % 1'000'000'000 / shown;
    std::string text =
        fmt::format("{}{:04}-{:02}-{:02} {:02}:{:02}:{:02}", d.year < 0 ? "-" : "",
                    std::abs(d.year), d.month, d.day, second / 3600, second / 60 % 60, second % 60);
    if (fraction != 0) text += fmt::format(".{:0{}}", fraction, decimals);
    return text;
}

double TimeUnits::convert(const Number& value, const TimeUnits& other) const {
    assert(calendar_ == other.calendar_);
    const Wide apart = static_cast<Wide>(other.referenceDay_ - referenceDay_) * kDayNs +
                       other.referenceNs_ - referenceNs_;
    if (other.unitNs_ == unitNs_ && apart == 0) return toDouble(value);
    const auto since = timesUnit(value, other.unitNs_);
    if (!since) return std::numeric_limits<double>::quiet_NaN();
    // Whole units and the rest apart: their nanoseconds together may need more bits than a long
    // double has.
    const Wide ns = *since + apart;
    return static_cast<double>(static_cast<long double>(ns / unitNs_) +
                               static_cast<long double>(ns % unitNs_) /
                                   static_cast<long double>(unitNs_));
}

}  // namespace timeseries
