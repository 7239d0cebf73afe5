// Finds a point of the grid among a step's points. They lie in order of value, so all of them may
// have to be looked through; some at a time, so that no frame waits. Pure.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "timeseries/index/sorted_step.h"

namespace app::headset {

class PointSearch {
 public:
    // Looks on through at most `points` more of the step's points; from the first again where it
    // was another step or another point.
    void look(std::shared_ptr<const timeseries::SortedStep> step, std::uint64_t gridIndex,
              std::uint64_t points);
    // Whether it is found, or all of the step was looked through.
    bool ended() const;
    // Its place in the step. None before the end, and where the step has no value there: missing,
    // or not kept.
    std::optional<std::uint64_t> found() const { return found_; }

 private:
    std::shared_ptr<const timeseries::SortedStep> step_;
    std::uint64_t gridIndex_ = 0, looked_ = 0;
    std::optional<std::uint64_t> found_;
};

}  // namespace app::headset
