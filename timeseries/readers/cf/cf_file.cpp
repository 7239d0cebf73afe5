#include "timeseries/readers/cf/cf_file.h"

#include <fmt/format.h>

namespace timeseries {

std::string CfFile::sentence(std::string_view place, std::string_view what) const {
    // Names and texts come from the file: whatever they hold, it stays one line.
    std::string sentence = fmt::format("{}{}{}", place, place.empty() ? "" : ": ", what);
    for (char& c : sentence)
        if (c >= '\0' && c < ' ') c = ' ';
    return path_.string() + ": " + sentence;
}

void CfFile::fail(std::string_view place, std::string_view what) const {
    throw FileError(sentence(place, what));
}

void CfFile::failAttribute(const NcVariable& variable, std::string_view what) const {
    throw AttributeError(sentence("variable '" + variable.name + "'", what));
}

}  // namespace timeseries
