#include "timeseries/readers/text/shell_word.h"

#include <algorithm>
#include <string_view>

namespace timeseries {
namespace {

bool isSafe(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-+=:,./@%").find(c) != std::string_view::npos;
}

}  // namespace

// POSIX shell, 2.2.2: between single quotes every character is itself; a single quote stands
// outside.
std::string shellWord(const std::string& word) {
    if (!word.empty() && std::ranges::all_of(word, isSafe)) return word;
    std::string text = "'";
    for (const char c : word) {
        if (c == '\'')
            text += "'\\''";
        else
            text += c;
    }
    return text + "'";
}

}  // namespace timeseries
