#include "timeseries/readers/text/date_text.h"

namespace timeseries {
namespace {

constexpr std::size_t kDayLength = 10, kSecondLength = 19;

bool isDecimal(char c) { return c >= '0' && c <= '9'; }

// 'd' stands for a digit, any other for itself.
bool isLike(std::string_view text, std::string_view form) {
    if (text.size() != form.size()) return false;
    for (std::size_t i = 0; i < form.size(); ++i)
        if (form[i] == 'd' ? !isDecimal(text[i]) : text[i] != form[i]) return false;
    return true;
}

// REQUIRES: digits.
int ofDigits(std::string_view digits) {
    int number = 0;
    for (const char c : digits) number = 10 * number + (c - '0');
    return number;
}

// Of what stands behind the seconds: ".25", "Z", ".25Z" or nothing.
std::optional<std::int64_t> nanosecondsOf(std::string_view rest) {
    if (rest.ends_with('Z')) rest.remove_suffix(1);
    if (rest.empty()) return 0;
    if (rest[0] != '.' || rest.size() == 1) return std::nullopt;
    std::int64_t nanoseconds = 0, place = 100'000'000;
    for (const char c : rest.substr(1)) {
        if (!isDecimal(c)) return std::nullopt;
        nanoseconds += place * (c - '0');
        place /= 10;
    }
    return nanoseconds;
}

}  // namespace

std::optional<Moment> momentOfText(std::string_view text, Calendar calendar) {
    if (!isLike(text.substr(0, kDayLength), "dddd-dd-dd")) return std::nullopt;
    const CivilDate date{yearAsWritten(calendar, ofDigits(text.substr(0, 4))),
                         ofDigits(text.substr(5, 2)), ofDigits(text.substr(8, 2))};
    if (!exists(calendar, date)) return std::nullopt;
    Moment moment{dayNumber(calendar, date), 0, 0};
    if (text.size() == kDayLength) return moment;

    const char between = text[kDayLength];
    const std::string_view clock =
        text.substr(kDayLength + 1).substr(0, kSecondLength - kDayLength - 1);
    if ((between != '_' && between != 'T' && between != ' ') || !isLike(clock, "dd:dd:dd"))
        return std::nullopt;
    const int hour = ofDigits(clock.substr(0, 2)), minute = ofDigits(clock.substr(3, 2)),
              second = ofDigits(clock.substr(6, 2));
    const auto nanoseconds = nanosecondsOf(text.substr(kSecondLength));
    if (hour > 23 || minute > 59 || second > 59 || !nanoseconds) return std::nullopt;
    moment.second = (hour * 60 + minute) * 60 + second;
    moment.nanoseconds = *nanoseconds;
    return moment;
}

std::string dateOfText(std::string_view text) {
    if (text.size() == kDayLength) return std::string(text) + " 00:00:00";
    std::string date(text.substr(0, kSecondLength));
    date[kDayLength] = ' ';
    return date;
}

}  // namespace timeseries
