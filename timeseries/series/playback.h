// What moves while the user watches: the time step, the window of values, or both. No data and no
// clock of its own: the front end says how much time has passed (extreme case "dropped frames": a
// slow picture skips steps, it does not slow the play).
#pragma once

#include <chrono>
#include <optional>

#include "timeseries/series/time_cursor.h"
#include "timeseries/series/value_sweep.h"

namespace timeseries {

// A plain value: copy it for undo, compare it, write its members' settings and positions to a file.
// The two cursors do not know of each other; each may be alone.
struct Playback {
    struct Change {
        bool step = false, window = false;
        friend bool operator==(const Change&, const Change&) = default;
    };

    std::optional<TimeCursor> time = {};   // none: the values are all that moves
    std::optional<ValueSweep> sweep = {};  // none: no layer's window is animated
    // Which of them move while playing; the others stay where they are, and can be sought.
    bool timeMoves = true;
    bool sweepMoves = true;
    bool playing = false;

    // A time cursor that had finished begins again, one that stands aside enters. Nothing happens
    // where nothing would ever move.
    void play();
    void pause() { playing = false; }
    void toggle() { playing ? pause() : play(); }

    // Says what is now another step or another window. Pauses when nothing will move any more.
    // Exact: advance(a) then advance(b) is advance(a + b). A negative dt counts as none.
    Change advance(std::chrono::nanoseconds dt);
    // When advance() next changes what is seen; none when it will not: a window may sleep so long.
    std::optional<std::chrono::nanoseconds> untilNextChange() const;

    friend bool operator==(const Playback&, const Playback&) = default;
};

}  // namespace timeseries
