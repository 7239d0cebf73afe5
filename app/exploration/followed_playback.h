// What plays, as the explorer says it: between the choices that a user makes and the cursors that
// move.
#pragma once

#include "app/choices/explorer.h"
#include "timeseries/readers/reader.h"
#include "timeseries/series/playback.h"

namespace app {

// Paused, at the explorer's step and tick. Brings into the axis and the sweep what lies outside: in
// and out points beyond the last step are the whole series again, the tick becomes the sweep's.
// REQUIRES: a resolved explorer. Throws std::invalid_argument (one sentence) for settings that
// timeseries refuses.
timeseries::Playback playbackOf(Explorer& explorer, const timeseries::TimeAxis& axis);

// The playback after an edit from `before` to `after`: what the edit leaves alone goes on
// where it is. Sets after.play.tick to where the window then stands. Throws as above.
timeseries::Playback followed(timeseries::Playback playback, const Explorer& before,
                              Explorer& after);

}  // namespace app
