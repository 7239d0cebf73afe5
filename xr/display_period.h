// From one refresh of a headset's display to the next. A runtime predicts longer ones to a program
// that is slow (Monado: whole multiples): to fill those would make it slower still. Pure.
#pragma once

#include <chrono>

namespace xr {

class DisplayPeriod {
 public:
    // A frame's predicted period. What no display has (under 1 ms, over 1 s) is passed over.
    void predicted(std::chrono::nanoseconds period);
    // The display's rate in Hz, as the runtime tells it: counts until the next one. A number that
    // is no rate is passed over.
    void told(double rate);
    // As told; else the least that was predicted since the rate was asked to change. 0 before that.
    std::chrono::nanoseconds now() const;
    // The rate will be another: what was predicted before says nothing any more.
    void forget() { told_ = least_ = std::chrono::nanoseconds(0); }

 private:
    std::chrono::nanoseconds told_{0}, least_{0};
};

}  // namespace xr
