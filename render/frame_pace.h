// How many splats a frame may hold to keep a frame time: learnt from the frames before. Pure; a
// value.
#pragma once

#include <chrono>
#include <cstdint>

namespace render {

// Models a frame's time as fixed + splats * perSplat and follows both slowly, so that one late
// frame changes little and a lasting change is followed within some ten frames.
class FramePace {
 public:
    explicit FramePace(std::chrono::nanoseconds target);

    void setTarget(std::chrono::nanoseconds target);
    // A frame of `splats` splats (all eyes together) took so long.
    void took(std::uint64_t splats, std::chrono::nanoseconds time);
    // The most for the target, at least kFewest; with hysteresis: it changes only by 10 % or more.
    std::uint64_t budget() const { return budget_; }

    static constexpr std::uint64_t kFewest = 20'000;

 private:
    double targetNs_, fixedNs_ = 0, perSplatNs_ = 0;
    std::uint64_t budget_;
};

}  // namespace render
