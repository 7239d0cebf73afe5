// One word of a POSIX shell's command line, for sentences and lines that are to be pasted.
#pragma once

#include <string>

namespace timeseries {

// Quoted where needed.
std::string shellWord(const std::string& word);

}  // namespace timeseries
