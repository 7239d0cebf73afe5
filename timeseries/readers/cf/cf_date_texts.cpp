#include "timeseries/readers/cf/cf_date_texts.h"

#include <fmt/format.h>

#include <algorithm>

#include "timeseries/readers/text/date_text.h"

namespace timeseries {
namespace {

constexpr std::uint64_t kMaxTextBytes = 256;  // rows of more are no dates

// The texts' own, else the file's; "" for CF's default.
std::string calendarOfTexts(const NcHeader& header, const NcVariable& texts) {
    if (std::string own = texts.text("calendar"); !own.empty()) return own;
    const NcGroup* const root = header.findGroup("");
    if (!root) return "";
    for (const char* const name :
         {"calendar", "CALENDAR", "config_calendar_type"})  // the last, MPAS
        if (std::string calendar = root->text(name); !calendar.empty()) return calendar;
    return "";
}

// As it may stand in a note: short, and of one line.
std::string asTold(std::string_view text) {
    constexpr std::size_t kMostTold = 40;
    std::string told(text.substr(0, kMostTold));
    for (char& c : told)
        if (c < ' ' || c > '~') c = '?';
    return fmt::format("\"{}{}\"", told, text.size() > kMostTold ? "..." : "");
}

struct Dates {
    std::string first;  // as "2000-02-28 23:00:00"
    std::vector<Moment> moments;
};

// Throws FileError for what is no date.
Dates datesOf(const CfFile& file, const NcVariable& texts, Calendar calendar) {
    constexpr std::size_t kAtATime = 4096;  // what is damaged may declare any number
    constexpr std::string_view kExpected = "expected dates such as 2000-01-31_12:00:00, found ";
    const NcHeader& header = file.header();
    const std::uint64_t steps = header.dimension(texts, 0).length;
    if (texts.dimensions.size() == 2 && header.dimension(texts, 1).length > kMaxTextBytes)
        throw FileError(
            fmt::format("{}rows of {} characters", kExpected, header.dimension(texts, 1).length));
    Dates dates;
    while (dates.moments.size() < steps) {
        const std::size_t begin = dates.moments.size();
        const auto some = file.texts(texts, begin, std::min(kAtATime, steps - begin));
        if (!some) throw FileError(fmt::format("{}no texts that are read", kExpected));
        for (const std::string& text : *some) {
            const auto moment = momentOfText(text, calendar);
            if (!moment) throw FileError(fmt::format("{}{}", kExpected, asTold(text)));
            if (dates.moments.empty()) dates.first = dateOfText(text);
            dates.moments.push_back(*moment);
        }
    }
    return dates;
}

// Since the first, without its fraction: whole ones exactly.
std::vector<Number> secondsOf(const std::vector<Moment>& moments) {
    constexpr std::int64_t kDay = 86'400;
    const bool areWhole =
        std::ranges::all_of(moments, [](const Moment& m) { return m.nanoseconds == 0; });
    std::vector<Number> seconds;
    seconds.reserve(moments.size());
    for (const Moment& moment : moments) {
        const std::int64_t whole =
            (moment.day - moments.front().day) * kDay + moment.second - moments.front().second;
        if (areWhole)
            seconds.emplace_back(whole);
        else
            seconds.emplace_back(
                static_cast<double>(static_cast<long double>(whole) +
                                    static_cast<long double>(moment.nanoseconds) / 1'000'000'000));
    }
    return seconds;
}

}  // namespace

void readDateTexts(const CfFile& file, const NcVariable& texts, StoredTimes& times) {
    const std::string name(texts.baseName());
    try {
        const std::string calendarText = calendarOfTexts(file.header(), texts);
        const auto calendar = calendarFromName(calendarText);
        if (!calendar)
            throw FileError(fmt::format("the calendar {} is not known", asTold(calendarText)));
        const Dates dates = datesOf(file, texts, *calendar);
        times.values = secondsOf(dates.moments);
        times.name = name;
        times.units = "seconds since " + dates.first;
        times.calendar = calendarText;
        times.counted = false;
        times.inText = true;
    } catch (const FileError& flaw) {
        times.note = fmt::format("{} is not read, steps are counted: {}", name, flaw.what());
    }
}

}  // namespace timeseries
