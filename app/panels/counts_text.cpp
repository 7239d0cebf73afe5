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

std::string percentText(std::uint64_t count, std::uint64_t of) {
    constexpr double kLeastTold = 1e-4;
    if (of == 0) return "";
    if (count == 0) return "0 %";
    const double share = 100 * static_cast<double>(count) / static_cast<double>(of);
    if (share < kLeastTold) return "below 0.0001 %";
    return fmt::format("{:.{}f} %", share, share >= 10 ? 1 : share >= 0.1 ? 2 : 4);
}

}  // namespace app::panels
