// The window of values that sweeps or swings through a field: the animation of Crawfis 1996, "Fast
// volume rendering of data slices", section "Animating the interval sets". No data, no clock of its
// own: a value that an undo stack may copy and a session file may write.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "timeseries/index/range_set.h"

namespace timeseries {

enum class SweepPath {
    Loop,   // linear from the lowest value to the highest, then from the lowest again
    Swing,  // there and back on a cosine: no jump, slowest at both ends
};

struct SweepSettings {
    // Where the window's centre goes, apart from what is kept or selected. Finite ends only: the
    // caller puts the field's least and greatest value for "min" and "max".
    RangeSet animation;
    double delta = 0;               // the window is the centre +- delta; finite, >= 0
    std::int64_t timerSteps = 256;  // in 1 .. 2^30; 256 are the entries of a usual colour table
    std::int64_t step = 1;          // the timer counts by this many; in 1 .. 2^30
    double frequency = 0.1;         // cycles per second, finite, >= 0; 0 stands still
    SweepPath path = SweepPath::Swing;
    friend bool operator==(const SweepSettings&, const SweepSettings&) = default;
};

// Where a sweep stands.
struct SweepPosition {
    std::int64_t tick = 0;
    std::chrono::nanoseconds into{0};  // since the tick began; less than its length
    friend bool operator==(const SweepPosition&, const SweepPosition&) = default;
};

// A timer counts q = 0, K, 2K, ... below timerSteps T, K being `step`, and begins again at 0: a
// tick is one such state, and a cycle has ceil(T / K) of them, all equally long. (Open Inventor's
// SoTimeCounter, which the paper uses, does the same: when K does not divide T the last count falls
// short of the last timer step.) A cycle lasts 1 / frequency seconds whatever K is, rounded to a
// whole nanosecond and no shorter than a nanosecond a tick, so there are frequency * ceil(T / K)
// redraws a second: the paper's 256 F / K where K divides 256.
//
// Where the centre is depends on the tick alone. Loop: the fraction q / (T - 1) of the way, so that
// a K that divides T - 1 shows both ends. Swing: (1 - cos(2 pi q / T)) / 2, so that q and T - q
// show the same value, bit for bit. The way is the animation ranges put end to end: gaps take no
// time. Where a range has no length (a single value) it takes no time either, unless none has any:
// then the values themselves are shown, each for an equal part.
class ValueSweep {
 public:
    // Throws std::invalid_argument (one sentence) when a setting is outside what is stated above or
    // the animation holds no value or an infinite end. A position outside the cycle is brought
    // inside.
    explicit ValueSweep(SweepSettings settings, SweepPosition position = {});

    const SweepSettings& settings() const { return settings_; }
    const SweepPosition& position() const { return position_; }
    std::int64_t tick() const { return position_.tick; }
    std::int64_t ticksPerCycle() const { return ticks_; }
    // None when the frequency is 0 or rounds a cycle beyond 2^60 ns (36 years).
    std::optional<std::chrono::nanoseconds> cycle() const;

    // Same place on the way, as nearly as the new timer's steps allow. Throws as the constructor
    // does.
    void set(SweepSettings settings);
    // To the beginning of a tick. REQUIRES: 0 <= tick < ticksPerCycle().
    void seek(std::int64_t tick);
    // Exact: advance(a) then advance(b) is advance(a + b). A negative dt counts as none.
    void advance(std::chrono::nanoseconds dt);
    // None when the window does not move.
    std::optional<std::chrono::nanoseconds> untilNextTick() const;

    // REQUIRES for these three: 0 <= tick < ticksPerCycle().
    // Always inside the animation ranges, open ends included: never in a gap.
    // Where ranges end at whole numbers that doubles tell not all apart it is one of those, rounded
    // here alone.
    double contour(std::int64_t tick) const { return toDouble(exactContour(tick)); }
    Number exactContour(std::int64_t tick) const;
    // [contour - delta, contour + delta], closed; of the exact one. Not clipped: as in the paper it
    // reaches beyond the animation ranges, into gaps too, so that a contour at an end looks as
    // thick as any other.
    Range window(std::int64_t tick) const;
    // In [0, 1]: how far along the way the contour is, for a colour or opacity table that follows
    // it (the paper's second calculator). Count q picks entry q of a table of timerSteps in a Loop.
    double tablePosition(std::int64_t tick) const;

    double contour() const { return contour(tick()); }
    Range window() const { return window(tick()); }
    double tablePosition() const { return tablePosition(tick()); }

    friend bool operator==(const ValueSweep& a, const ValueSweep& b) {
        return a.settings_ == b.settings_ && a.position_ == b.position_;
    }

 private:
    std::chrono::nanoseconds begin(std::int64_t tick) const;  // REQUIRES: cycle_ > 0
    std::chrono::nanoseconds length(std::int64_t tick) const;

    // 64-bit integers and their differences.
    __extension__ using Wide = __int128;
    // Which range, and how much of it lies before it, in [0, 1].
    struct Place {
        std::size_t range;
        double along;
    };
    Place placeOf(std::int64_t tick) const;
    Wide wholeContour(std::int64_t tick) const;  // REQUIRES: wholes_ are there
    static std::vector<Interval<Wide>> wholesOf(const RangeSet& animation);

    SweepSettings settings_;
    std::vector<Interval<double>> ranges_;  // settings_.animation in doubles; never empty
    std::vector<Interval<Wide>> wholes_;    // in whole numbers, where doubles do not have them all
    std::vector<double> halfLengths_;       // of these, or of ranges_: the widest would overflow
    double halfLength_ = 0;                 // of all
    std::int64_t ticks_ = 1;
    std::int64_t cycle_ = 0;  // nanoseconds; 0 stands still, else >= ticks_
    SweepPosition position_;
};

}  // namespace timeseries
