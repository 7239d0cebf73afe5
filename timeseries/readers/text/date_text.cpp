#include "timeseries/readers/text/date_text.h"

#include <algorithm>

#include "timeseries/readers/text/time_units.h"

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

// Of what referenceOf() reads, the one form: no day's end at 24:00:00 and no leap second either.
bool isOfTheForm(std::string_view text) {
    if (!isLike(text.substr(0, kDayLength), "dddd-dd-dd")) return false;
    if (text.size() == kDayLength) return true;
    const char between = text[kDayLength];
    if (between != '_' && between != 'T' && between != ' ') return false;
    const std::string_view clock =
        text.substr(kDayLength + 1).substr(0, kSecondLength - kDayLength - 1);
    if (!isLike(clock, "dd:dd:dd") || clock >= "24" || clock.substr(6) > "59") return false;
    std::string_view rest = text.substr(kSecondLength);
    if (rest.ends_with('Z')) rest.remove_suffix(1);
    return rest.empty() ||
           (rest[0] == '.' && rest.size() > 1 && std::ranges::all_of(rest.substr(1), isDecimal));
}

}  // namespace

std::optional<Moment> momentOfText(std::string_view text, Calendar calendar) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    if (!isOfTheForm(text)) return std::nullopt;
    std::string reference(text);
    if (reference.size() > kDayLength) reference[kDayLength] = ' ';
    const auto found = referenceOf(reference, calendar);
    if (!found) return std::nullopt;
    return Moment{found->day, found->ns / kSecond, found->ns % kSecond};
}

std::string dateOfText(std::string_view text) {
    if (text.size() == kDayLength) return std::string(text) + " 00:00:00";
    std::string date(text.substr(0, kSecondLength));
    date[kDayLength] = ' ';
    return date;
}

}  // namespace timeseries
