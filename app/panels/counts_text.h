// How many points or cells a picture has, in words.
#pragma once

#include <cstdint>
#include <string>

namespace app::panels {

// What was drawn, and what all of it would be. A point of several layers is drawn in each: one
// point, several splats.
struct DrawnCounts {
    std::uint64_t splats = 0, allSplats = 0, points = 0;  // `points`: selected, each counted once
};
// "100 points drawn", "100 points drawn, as 120 splats", "30 of 120 splats drawn".
std::string drawnText(const DrawnCounts& drawn);
// "1 cell drawn", "3,321 cells drawn", "3,321 cells and 20 points drawn".
std::string cellsText(std::uint64_t cells, std::uint64_t points = 0);

// "12.3 %", "0.25 %", "0.0031 %", "0 %" of none alone; "" of nothing.
std::string percentText(std::uint64_t count, std::uint64_t of);

}  // namespace app::panels
