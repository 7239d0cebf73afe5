#include "timeseries/readers/placed_by_index.h"

#include <fmt/format.h>

namespace timeseries {

void notePlacedByIndex(std::vector<std::string>& notes, std::string_view axis,
                       std::string_view what) {
    const std::string ofOne = fmt::format(" is placed by index: the file has no {} for it", what),
                      ofMore =
                          fmt::format(" are placed by index: the file has no {} for them", what);
    for (std::string& note : notes) {
        if (note.ends_with(ofOne)) {
            note.resize(note.size() - ofOne.size());
        } else if (note.ends_with(ofMore)) {
            note.resize(note.size() - ofMore.size());
            note.replace(note.rfind(" and "), std::string_view(" and ").size(), ", ");
        } else {
            continue;
        }
        note += fmt::format(" and {}{}", axis, ofMore);
        return;
    }
    notes.push_back(fmt::format("{}{}", axis, ofOne));
}

}  // namespace timeseries
