#include "timeseries/readers/text/date_text.h"

#include <fmt/format.h>

#include "timeseries/readers/text/time_units.h"

namespace timeseries {
namespace {

bool isDecimal(char c) { return c >= '0' && c <= '9'; }

// 'd' stands for a digit, any other for itself.
bool isLike(std::string_view text, std::string_view form) {
    if (text.size() != form.size()) return false;
    for (std::size_t i = 0; i < form.size(); ++i)
        if (form[i] == 'd' ? !isDecimal(text[i]) : text[i] != form[i]) return false;
    return true;
}

// Takes what is so spelled from the beginning; "" where it is not.
std::string_view taken(std::string_view& text, std::string_view form) {
    const std::string_view start = text.substr(0, form.size());
    if (!isLike(start, form)) return "";
    text.remove_prefix(form.size());
    return start;
}

// "Z", "UTC" or an offset as referenceOf() reads it; nothing for what is none.
std::optional<std::string> zoneOf(std::string_view text) {
    const bool isApart = text.starts_with(' ');
    if (isApart) text.remove_prefix(1);
    if (text.empty()) return isApart ? std::nullopt : std::optional("");
    if (text == "UTC" || (text == "Z" && !isApart)) return "";
    for (const std::string_view form : {"+dd:dd", "-dd:dd", "+dddd", "-dddd", "+dd", "-dd"})
        if (isLike(text, form)) return fmt::format(" {}", text);
    return std::nullopt;
}

// A text of one of the forms, spelled as referenceOf() reads it: "2000-01-31 12:00:00", a fraction
// and a zone. Nothing for another, nor for a day's end at 24:00:00 or a leap second.
struct Spelled {
    std::string second, fraction, zone;
};
std::optional<Spelled> spelled(std::string_view text) {
    std::string day(taken(text, "dddd-dd-dd"));
    const bool isShort = day.empty();  // ISO 8601's basic format
    if (isShort) {
        const std::string_view digits = taken(text, "dddddddd");
        if (digits.empty()) return std::nullopt;
        day = fmt::format("{}-{}-{}", digits.substr(0, 4), digits.substr(4, 2), digits.substr(6));
    }
    if (text.empty()) return Spelled{day + " 00:00:00", "", ""};
    if (text[0] != '_' && text[0] != 'T' && text[0] != ' ') return std::nullopt;
    text.remove_prefix(1);
    std::string clock(taken(text, isShort ? "dddd" : "dd:dd"));
    if (clock.empty()) return std::nullopt;
    if (isShort) clock.insert(2, ":");
    std::string seconds(taken(text, isShort ? "dd" : ":dd")), fraction;
    if (isShort && !seconds.empty()) seconds.insert(0, ":");
    if (!seconds.empty() && text.starts_with('.')) {
        const std::size_t end = text.find_first_not_of("0123456789", 1);
        fraction = text.substr(0, end);
        if (fraction.size() < 2) return std::nullopt;
        text.remove_prefix(fraction.size());
    }
    if (seconds.empty()) seconds = ":00";
    const auto zone = zoneOf(text);
    if (clock >= "24" || seconds > ":59" || !zone) return std::nullopt;
    return Spelled{fmt::format("{} {}{}", day, clock, seconds), fraction, *zone};
}

}  // namespace

std::optional<Moment> momentOfText(std::string_view text, Calendar calendar) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    const auto parts = spelled(text);
    if (!parts) return std::nullopt;
    const auto found = referenceOf(parts->second + parts->fraction + parts->zone, calendar);
    if (!found) return std::nullopt;
    return Moment{found->day, found->ns / kSecond, found->ns % kSecond};
}

std::string dateOfText(std::string_view text) {
    const auto parts = spelled(text);
    return parts ? parts->second + parts->zone : "";
}

}  // namespace timeseries
