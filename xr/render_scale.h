// The share of the headset's recommended resolution that its frame loop can hold. Pure: a function
// of recorded frame times.
#pragma once

#include <chrono>

namespace xr {

// Lowers the scale while frames take longer than the runtime's period, climbs back slowly where
// there is room; between 0.5 and 1, in steps small enough not to be seen as a jump. A single late
// frame changes nothing.
class RenderScale {
 public:
    // `period`: the runtime's predicted display period, > 0. `frame`: what drawing took.
    void took(std::chrono::nanoseconds frame, std::chrono::nanoseconds period);
    // Of the recommended width and height.
    double scale() const { return scaleAfter(lowered_); }
    bool lowest() const { return lowered_ == kMostLowered; }  // there is no less

    static constexpr int kLateFrames = 3;  // in a row, before a step down
    // Of quick frames in a row, before a step up: as long on a slow display as on a quick one.
    static constexpr std::chrono::nanoseconds kQuickTime = std::chrono::milliseconds(400);
    static constexpr double kLate = 0.95, kQuick = 0.85;  // of the period

 private:
    // Integer steps of 1/20, so that equal scales are the same number.
    static constexpr int kSteps = 20, kMostLowered = 10;
    static double scaleAfter(int lowered) { return static_cast<double>(kSteps - lowered) / kSteps; }

    int lowered_ = 0;
    int lateFrames_ = 0;
    std::chrono::nanoseconds quickTime_{0};
};

}  // namespace xr
