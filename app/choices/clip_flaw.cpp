#include "app/choices/clip_flaw.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/choices/choice_text.h"

namespace app {

std::string clipFlaw(const ClipBox& clip, const timeseries::Grid& grid) {
    for (int a = 0; a < 3; ++a) {
        const timeseries::Axis& axis = grid.axes()[a];
        const auto& c = axis.coordinates;
        const auto [least, most] = std::minmax(c.front(), c.back());
        // A mesh has points anywhere between its ends, or so it is taken.
        const bool isMet = grid.mesh() ? clip.lo[a] <= most && least <= clip.hi[a]
                                       : std::ranges::any_of(c, [&](double x) {
                                             return clip.lo[a] <= x && x <= clip.hi[a];
                                         });
        if (isMet) continue;
        return fmt::format(
            "clip '{}' holds no point: {}, from {:.7g} to {:.7g}{}{}, has none from {} to {}",
            clipText(clip), axis.name, least, most, axis.units.empty() ? "" : " ", axis.units,
            clip.lo[a], clip.hi[a]);
    }
    return "";
}

}  // namespace app
