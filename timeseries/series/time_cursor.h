// Which time step is shown, while playing and by hand. No data, no clock of its own: a value that
// an undo stack may copy and a session file may write. All time is integer nanoseconds, so that
// days of odd frame durations end exactly where the closed form says.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace timeseries {

enum class Ending {
    Once,      // stops when the last step has had its time
    Loop,      // the first follows the last
    PingPong,  // there and back; the two end steps are shown once each
};
enum class Direction { Forward, Backward };
enum class Pace {
    Even,       // stepsPerSecond
    RealTimes,  // each step for its own duration, timeUnitsPerSecond
};

struct CursorSettings {
    std::size_t first = 0;                            // in point
    std::size_t last = static_cast<std::size_t>(-1);  // out point, inclusive; cut to the last step
    std::size_t stride = 1;                           // >= 1: first, first + stride, ... are shown
    Ending ending = Ending::Loop;
    Direction direction = Direction::Forward;  // of the way out, in PingPong
    Pace pace = Pace::Even;
    double stepsPerSecond = 10;     // shown steps; finite, >= 0; 0 stands still
    double timeUnitsPerSecond = 1;  // units of the time axis; finite, >= 0; 0 stands still
    friend bool operator==(const CursorSettings&, const CursorSettings&) = default;
};

// Where a cursor stands.
struct CursorPosition {
    std::size_t place = 0;
    std::chrono::nanoseconds into{0};  // less than the place's duration; equal when finished
    friend bool operator==(const CursorPosition&, const CursorPosition&) = default;
};

// The shown steps, in the order of one cycle, are the places 0, 1, ... placesPerCycle() - 1. By
// hand a cursor goes to any step of the series: it then stands aside of what plays, and its
// position is that of the shown step nearest to it, the earlier of two, where play goes on.
//
// In real times a step stays until the time of the step `stride` after it; where the series ends
// before that, as long as the shown step before it. Times that are NaN, infinite or not increasing
// anywhere among the steps that count give no durations: the pace is then Even, and whyEven() says
// so.
//
// A cycle's boundaries are rounded to nanoseconds once, from its beginning; each step has at least
// 1 ns, and a cycle no more than about 2^60 ns (36 years).
class TimeCursor {
 public:
    // Even pace only. Both throw std::invalid_argument (one sentence) for a series without steps
    // and for settings outside what is stated above. A position outside the cycle is brought
    // inside.
    explicit TimeCursor(std::size_t steps = 1, CursorSettings settings = {},
                        CursorPosition position = {});
    // times[i] is when step i is, in the units of the time axis.
    explicit TimeCursor(const std::vector<double>& times, CursorSettings settings = {},
                        CursorPosition position = {});

    std::size_t step() const { return aside_.value_or(stepOfPlace(position_.place)); }
    bool isAside() const { return aside_.has_value(); }
    std::size_t stepCount() const { return steps_; }
    const CursorSettings& settings() const { return settings_; }  // `last` as cut
    const CursorPosition& position() const { return position_; }
    std::size_t placesPerCycle() const { return begins_->size() - 1; }
    std::size_t stepOfPlace(std::size_t place) const;  // REQUIRES: place < placesPerCycle()
    // None unless real times are asked for and cannot be followed; one sentence.
    const std::optional<std::string>& whyEven() const { return whyEven_; }
    bool finished() const;  // Once only
    // Once alone: the step shown is the last to be shown, of several; played on, it would only end.
    bool atLast() const;

    // Keeps the step; aside where it does not play any more. Throws as the constructors do.
    void set(CursorSettings settings);
    // To the beginning of a step, on the way that is being played; beyond the last is the last.
    void seek(std::size_t step);
    // By hand, to the shown step next later or earlier whichever way is played. Past an end: Loop
    // goes round, the others stay. Before the in point and after the out point to the very next
    // step, as far as the series goes.
    void stepForward() { stepTo(Side::Later); }
    void stepBackward() { stepTo(Side::Earlier); }
    void restart() { goTo({}); }
    // From aside to the beginning of the shown step nearest to it.
    void enter() { aside_.reset(); }

    // Enters, if it stands aside and does not stand still. Exact: advance(a) then advance(b) is
    // advance(a + b). A negative dt counts as none.
    void advance(std::chrono::nanoseconds dt);
    // The closed form: the step shown when `elapsed` has been played from the beginning of a cycle.
    std::size_t stepAt(std::chrono::nanoseconds elapsed) const;
    // How long one whole cycle plays; none when it stands still.
    std::optional<std::chrono::nanoseconds> cycle() const;
    // Until another step is shown or, in Once, the last has had its time; 1 ns aside. None when
    // neither comes.
    std::optional<std::chrono::nanoseconds> untilNextStep() const;
    // The step shown and those that playing would show next, in that order, each once, at most
    // `count`: what to load, most urgent first.
    std::vector<std::size_t> upcoming(std::size_t count) const;

    friend bool operator==(const TimeCursor& a, const TimeCursor& b);

 private:
    TimeCursor(std::size_t steps, std::shared_ptr<const std::vector<double>> times,
               CursorSettings settings, CursorPosition position);
    std::size_t shownCount() const {
        return (settings_.last - settings_.first) / settings_.stride + 1;
    }
    std::size_t shownOfPlace(std::size_t place) const;  // ascending in time
    std::size_t placeOf(std::size_t shown, bool returning) const;
    bool returning() const { return position_.place >= shownCount(); }
    bool standsStill() const;
    std::int64_t duration(std::size_t place) const {
        return (*begins_)[place + 1] - (*begins_)[place];
    }
    CursorPosition positionAt(std::int64_t phase) const;
    enum class Side { Earlier, Later };
    void stepTo(Side side);
    void goTo(CursorPosition position);
    void layOut();

    std::size_t steps_ = 1;
    std::shared_ptr<const std::vector<double>> times_;  // [steps]; null for even pace only
    CursorSettings settings_;
    // Derived from the above and shared by copies: where each place begins in the cycle, in
    // nanoseconds, and the cycle's length. Strictly ascending, [placesPerCycle + 1].
    std::shared_ptr<const std::vector<std::int64_t>> begins_;
    std::optional<std::string> whyEven_;
    CursorPosition position_;
    std::optional<std::size_t> aside_;  // not a shown step
};

}  // namespace timeseries
