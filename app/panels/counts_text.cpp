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

std::string cellsText(std::uint64_t cells) {
    return fmt::format("{} cell{} drawn", withCommas(cells), cells == 1 ? "" : "s");
}

}  // namespace app::panels
