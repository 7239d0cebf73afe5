#include "timeseries/readers/text/words.h"

#include <algorithm>

namespace timeseries {

std::vector<std::string> words(std::string_view text) {
    constexpr std::string_view kBlank(" \t\r\n\0", 5);
    std::vector<std::string> found;
    while (true) {
        const auto first = text.find_first_not_of(kBlank);
        if (first == std::string_view::npos) return found;
        text.remove_prefix(first);
        const auto end = std::min(text.find_first_of(kBlank), text.size());
        found.emplace_back(text.substr(0, end));
        text.remove_prefix(end);
    }
}

std::string oneLine(std::string_view text) {
    std::string line(text);
    std::ranges::replace_if(
        line, [](char c) { return c >= '\0' && c < ' '; }, ' ');
    line.resize(line.find_last_not_of(' ') + 1);
    return line;
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

}  // namespace timeseries
