// The share of the headset's recommended resolution that its frame loop can hold. Pure: a function
// of recorded frame times.
#pragma once

#include <chrono>

namespace xr {

// Lowers the scale when frames take longer than the runtime's period, climbs back slowly when there
// is room; between 0.5 and 1, in steps small enough not to be seen as a jump.
class RenderScale {
 public:
    // `period`: the runtime's predicted display period, > 0. `frame`: what drawing took.
    void took(std::chrono::nanoseconds frame, std::chrono::nanoseconds period);
    double scale() const { return scale_; }

 private:
    double scale_ = 1;
    int quickFrames_ = 0;
};

}  // namespace xr
