// Words of the text that files hold.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace timeseries {

// The words of a blank-separated list such as the attribute `coordinates`.
std::vector<std::string> words(std::string_view text);
// As it can stand in a line: control characters as blanks, none at the end.
std::string oneLine(std::string_view text);
// In ASCII alone, whatever the locale.
std::string lower(std::string_view text);

}  // namespace timeseries
