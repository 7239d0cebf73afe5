#include "app/choices/clip_flaw.h"

#include <fmt/format.h>

#include "app/choices/choice_text.h"

namespace app {

std::string clipFlaw(const ClipBox& clip, const timeseries::Grid& grid) {
    for (int a = 0; a < 3; ++a) {
        const auto along = static_cast<std::size_t>(a);
        // A mesh has points anywhere between its ends, or so it is taken; one that moves, in the
        // box of another step, where it is.
        const auto [least, most] = grid.ofOneStep() ? grid.mesh()->ends(a) : grid.ends(along);
        const bool isMet = grid.mesh()
                               ? clip.lo[a] <= most && least <= clip.hi[a]
                               : grid.placesWithin(along, clip.lo[a], clip.hi[a]).has_value();
        const timeseries::Axis& axis = grid.axes()[along];
        if (grid.mesh() && clip.lo[a] == clip.hi[a] && least < most)
            return fmt::format(
                "clip '{}' is a plane along {}, and the points of this grid lie in no plane: give "
                "a range, from:to",
                clipText(clip), axis.name);
        if (isMet) continue;
        return fmt::format(
            "clip '{}' holds no point: {}, from {:.7g} to {:.7g}{}{}, has none from {} to {}",
            clipText(clip), axis.name, least, most, axis.units.empty() ? "" : " ", axis.units,
            clip.lo[a], clip.hi[a]);
    }
    return "";
}

}  // namespace app
