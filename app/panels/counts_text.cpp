#include "app/panels/counts_text.h"

#include <fmt/format.h>

#include "app/files/dataset.h"

namespace app::panels {

std::string drawnText(const DrawnCounts& drawn) {
    const bool shared = drawn.allSplats > drawn.points;
    if (drawn.splats < drawn.allSplats)
        return fmt::format("{} of {} {} drawn", withCommas(drawn.splats),
                           withCommas(drawn.allSplats), shared ? "splats" : "points");
    if (!shared) return fmt::format("{} points drawn", withCommas(drawn.splats));
    return fmt::format("{} points drawn, as {} splats", withCommas(drawn.points),
                       withCommas(drawn.splats));
}

std::string cellsText(std::uint64_t cells, std::uint64_t points) {
    const auto several = [](std::uint64_t count, const char* what) {
        return fmt::format("{} {}{}", withCommas(count), what, count == 1 ? "" : "s");
    };
    return several(cells, "cell") + (points > 0 ? " and " + several(points, "point") : "") +
           " drawn";
}

}  // namespace app::panels
