#include "app/choices/map_flaw.h"

#include <fmt/format.h>

#include "render/points/globe.h"

namespace app {

std::string globeFlaw(const timeseries::Grid& grid) {
    if (!render::isOnEarth(grid)) {
        const auto told = [&](std::size_t axis) {
            const auto& [name, units, coordinates, down] = grid.axes()[axis];
            return units.empty() ? name : fmt::format("{} ({})", name, units);
        };
        if (render::saysDegrees(grid)) {
            const auto [least, most] = grid.ends(0);
            return fmt::format(
                "a globe is drawn of longitudes that go around it once, not from {:.7g} to {:.7g}",
                least, most);
        }
        return fmt::format(
            "a globe is drawn of longitudes and latitudes in degrees, not of {} and {}", told(0),
            told(1));
    }
    constexpr double kPole = render::Globe::kPole;
    if (const auto [lo, hi] = render::earthEnds(grid); lo.y < -kPole || hi.y > kPole)
        return fmt::format(
            "a globe is drawn of latitudes from -90 to 90, not from {:.7g} to {:.7g}", lo.y, hi.y);
    if (grid.count() > render::Globe::kMostPoints)
        return fmt::format("a globe is drawn of at most {} points, not of {}",
                           render::Globe::kMostPoints, grid.count());
    if (!render::Globe::shows(grid))
        return "a globe is drawn of more than one place, and of heights that are told apart";
    return "";
}

}  // namespace app
