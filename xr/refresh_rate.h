// Which of a display's rates its frame loop can hold. Pure: a function of recorded frame times.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "xr/render_scale.h"

namespace xr {

// Begins at the highest rate. Goes to the next lower one only where frames are late for long with
// the render scale at its lowest, and back where those of full scale would long have been in time:
// a change of rate is seen.
class RefreshRate {
 public:
    // In Hz, in any order. None: there is no choice, and nothing to ask for.
    explicit RefreshRate(std::vector<double> offered = {});

    // A frame takes so long at least, whatever can be left out of it, after which the scale is
    // this.
    void took(std::chrono::nanoseconds frame, const RenderScale& scale);
    // To be asked of the runtime.
    std::optional<double> wanted() const;
    // "72 of 90 Hz"; empty at the highest.
    std::string loweredText() const;

    static constexpr int kLateFrames = 45, kQuickFrames = 900;  // in a row

 private:
    // Of the period at this rate.
    double share(std::chrono::nanoseconds time, std::size_t rate) const;

    std::vector<double> rates_;  // descending
    std::size_t rate_ = 0;
    int lateFrames_ = 0, quickFrames_ = 0;
};

}  // namespace xr
