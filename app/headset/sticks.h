// The value and the time, played by hand: thumbsticks move the window of values and the step.
// Edits the exploration; knows no runtime.
#pragma once

#include <chrono>

#include "app/exploration/exploration.h"

namespace app::headset {

// A stick's rest is wider than its noise; beyond, finer near the middle. In [-1, 1].
double rateOf(double stick);

class Sticks {
 public:
    // What was reached and could not be passed.
    struct Ends {
        bool value = false, time = false;
    };
    // The swept window goes along its animation, where there is one; else the first visible layer
    // goes through the values of the step shown, as a drag of it would. A full way takes
    // kValueSeconds. A tap of the time stick is one step, at once; held, it passes them at a rate
    // that suits their number. `value` and `time`: the sticks, [-1, 1], right is more.
    Ends move(Exploration& exploration, double value, double time, std::chrono::nanoseconds dt);

    static constexpr double kValueSeconds = 4;

 private:
    bool moveWindow(Exploration& exploration, double ways);
    bool moveLayer(Exploration& exploration, double ways);
    bool moveTime(Exploration& exploration, double time, std::chrono::nanoseconds dt);

    double ticks_ = 0, steps_ = 0;  // less than one, still to be moved
    // The time stick's way since it left its rest.
    struct {
        double side = 0;  // -1, 1; 0 while it rests
        std::chrono::nanoseconds held{0};
        bool tapped = false;
    } timeWay_;
    bool dragging_ = false;
};

// The swept window turns round at its ends, or begins anew. Nothing without a sweep.
void toggleSwing(Exploration& exploration);

}  // namespace app::headset
