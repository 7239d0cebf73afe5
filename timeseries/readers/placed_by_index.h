// What is said of axes that a file counts and does not measure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace timeseries {

// Notes that the file has no `what` ("spacing") for this axis; axes of one variable are told
// together: "x, y and z are placed by index: the file has no spacing for them".
void notePlacedByIndex(std::vector<std::string>& notes, std::string_view axis,
                       std::string_view what);

}  // namespace timeseries
