// What is written near the hand: which values, when, how many points. Pure.
#pragma once

#include <optional>
#include <string>

#include "app/drawing/screen.h"
#include "app/exploration/exploration.h"
#include "app/headset/tip_probe.h"

namespace app::headset {

// Of the picture before the eyes, which follows what is asked for: null before the first.
struct SeenPicture {
    const Screen* screen = nullptr;
    std::optional<PointCounts> counts = {};
    std::string error = {};  // as it is said; "" where there is none
    bool mixesColors = false;
};

// First what is at the tip of the hand that it stands near, where that is in the volume: value and
// unit, and along each axis position and index. Then a line each, of the picture: the values shown
// (with units), the time and the step, how many points, the picture's error. And, where it is so,
// that colours are mixed, what is shown instead of what was asked for, that it plays, and the share
// of the headset's resolution that is drawn. Before there are data, what is being opened.
std::string readoutText(const Exploration& exploration, const SeenPicture& seen,
                        const std::optional<TipProbe::At>& tip, double renderScale);

}  // namespace app::headset
