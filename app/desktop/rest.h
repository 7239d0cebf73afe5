// When a picture that a hand changes is at rest, so that all of it may be drawn. A value; pure.
#pragma once

#include <chrono>

namespace app::desktop {

class Rest {
 public:
    using Clock = std::chrono::steady_clock;

    // A frame: whether its picture is another than the one before, and whether a mouse button is
    // held, with which a hand may go on to change it.
    void frame(bool changed, bool held, Clock::time_point now) {
        changed_ = changed;
        if (changed) {
            since_ = now;
            dragged_ = held || held_;
        }
        held_ = held;
    }
    // When nothing has changed for kHesitation, for a hand that hesitates is not made to wait; but
    // what was dragged, when it is let go.
    bool is(Clock::time_point now) const {
        return now - since_ >= kHesitation || (dragged_ && !held_ && !changed_);
    }

    static constexpr std::chrono::milliseconds kHesitation{150};

 private:
    Clock::time_point since_ = Clock::now();
    bool changed_ = false, held_ = false;  // at the last frame
    bool dragged_ = false;                 // what changed last, by a held button
};

}  // namespace app::desktop
