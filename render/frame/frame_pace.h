// How many splats a frame may hold to keep a frame time: learnt from the frames before. Pure; a
// value.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

namespace render {

// Models a frame's time as fixed + splats * perSplat: a line through the last eight frames, from
// medians (Theil 1950, Sen 1968), so that a single late frame changes nothing and a lasting change
// is followed within ten frames.
class FramePace {
 public:
    // `first`: the budget before the first frame.
    explicit FramePace(std::chrono::nanoseconds target, std::uint64_t first = kFirst);

    // A frame takes fixedNs and perSplatNs for each splat, as frames of up to `splats` told.
    struct Cost {
        double fixedNs, perSplatNs, splats;
        friend bool operator==(const Cost&, const Cost&) = default;
    };
    // None while frames are too few, too small or too much alike to tell what a splat costs.
    std::optional<Cost> learnt() const;
    // Forgets its frames for what another learnt, maybe on another machine: what the next ones take
    // counts as ever. REQUIRES: finite, not negative.
    void beginFrom(const Cost& learnt);

    // All that was learnt: as before the first frame.
    void forget();

    void setTarget(std::chrono::nanoseconds target);
    // A frame of `splats` splats (all eyes together) took so long.
    void took(std::uint64_t splats, std::chrono::nanoseconds time);
    // The most for the target, from kFewest to kMost, but no more than a few times what was drawn
    // lately: of more nothing is known. With hysteresis: it changes only by 10 % or more.
    std::uint64_t budget() const { return budget_; }

    // What so many splats take, as is known so far.
    std::chrono::nanoseconds costOf(std::uint64_t splats) const;
    // What a frame of so many splats takes, all of it, as is known so far; 0 before the first.
    std::chrono::nanoseconds predicted(std::uint64_t splats) const;
    // How many splats that time has room for, if it holds nothing but splats; the first budget
    // where nothing is known.
    std::uint64_t fitting(std::chrono::nanoseconds time) const;

    static constexpr std::uint64_t kFewest = 20'000, kFirst = 100'000,
                                   kMost = std::uint64_t{1} << 31;

 private:
    struct Sample {
        double splats, ns;
    };
    bool knows() const { return perSplatNs_ > 0; }
    void fit();
    void follow();
    double fittingTarget() const;

    double targetNs_, fixedNs_ = 0, perSplatNs_ = 0;
    double mostSplats_ = 0;  // of the frames that these are from
    bool isTold_ = false;    // what a splat costs, by frames that differ
    std::uint64_t first_, budget_;
    std::deque<Sample> recent_;
};

}  // namespace render
