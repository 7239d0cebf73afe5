#include "app/choices/clip_flaw.h"

#include <fmt/format.h>

#include "app/choices/choice_text.h"

namespace app {

std::string clipFlaw(const ClipBox& clip, const timeseries::Grid& grid) {
    for (int a = 0; a < 3; ++a) {
        const auto along = static_cast<std::size_t>(a);
        const auto [least, most] = grid.ends(along);
        // A mesh has points anywhere between its ends, or so it is taken.
        const bool isMet = grid.mesh()
                               ? clip.lo[a] <= most && least <= clip.hi[a]
                               : grid.placesWithin(along, clip.lo[a], clip.hi[a]).has_value();
        if (isMet) continue;
        const timeseries::Axis& axis = grid.axes()[along];
        return fmt::format(
            "clip '{}' holds no point: {}, from {:.7g} to {:.7g}{}{}, has none from {} to {}",
            clipText(clip), axis.name, least, most, axis.units.empty() ? "" : " ", axis.units,
            clip.lo[a], clip.hi[a]);
    }
    return "";
}

}  // namespace app
