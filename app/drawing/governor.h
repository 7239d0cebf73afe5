// What a picture that moves may hold so that its frames come in time: points and cells, whose costs
// are learnt apart from the frames before. Of the ladder (app/choices/rung.h) Canvas draws the
// truest that keeps to it. The window and the headset have one each, which differ in the time that
// they give and in how soon they give more. Pure: a function of recorded frame times.
#pragma once

#include <chrono>
#include <cstdint>

#include "app/choices/preferences.h"
#include "app/drawing/canvas.h"
#include "render/frame/frame_pace.h"

namespace app {

class Governor {
 public:
    enum class Rise {
        AtOnce,  // for a hand that drags for a second or two
        Proven,  // where a while has shown that they fit: for a picture that never rests
    };
    explicit Governor(Rise rise = Rise::AtOnce)
        : rise_(rise), firstCells_((rise == Rise::AtOnce ? 4 : 1) * render::FramePace::kFirst) {}

    // The time that drawing may take of a frame.
    void setTarget(std::chrono::nanoseconds target);

    // Of a frame that was drawn, or of one before; splats as render/splat/splat_cost.h counts.
    struct Drawn {
        std::uint64_t splats;
        bool areCells = false;
        double finer = 2;  // so many times as much the next finer subset costs
    };
    // `since`: how long after the frame before it; for rises that are to be proven.
    void took(const Drawn& drawn, std::chrono::nanoseconds time,
              std::chrono::nanoseconds since = {});

    // For the next frame, all eyes together. Fewer at once.
    CanvasLimits limits(const DepthErrors* errors) const;
    // What so many of them take more than none, as is known so far.
    std::chrono::nanoseconds costOf(const Drawn& drawn) const {
        return (drawn.areCells ? cells_ : points_).costOf(drawn.splats);
    }
    const render::FramePace& points() const { return points_; }
    render::FramePace& cells() { return cells_; }

    // What drawing was found to cost, by this or, so that its first frames already fit, by another.
    DrawingCosts costs() const { return {.points = points_.learnt(), .cells = cells_.learnt()}; }
    void beginFrom(const DrawingCosts& learnt);

 private:
    // Twenty frames a second still move.
    CanvasLimits::Slower slower() const;
    void follow(const Drawn& drawn, std::chrono::nanoseconds since);
    // Where cells were found to take too long, as in a first frame that made room for them, none
    // are drawn, and nothing tells when they would fit. So what fits less than it began with is
    // forgotten after a while without cells, which is twice as long each time, but not in a picture
    // that never rests.
    void forgetSlowCells();

    Rise rise_;
    std::chrono::nanoseconds target_{0};
    render::FramePace points_{std::chrono::milliseconds(8)};
    std::uint64_t firstCells_;
    render::FramePace cells_{std::chrono::milliseconds(8), firstCells_};
    unsigned withoutCells_ = 0, patience_ = kPatience;  // frames
    // Where a rise is to be proven, the most points:
    std::uint64_t proven_ = render::FramePace::kFirst;
    std::uint64_t risen_ = 0;  // the least that would have fitted for so long:
    std::chrono::nanoseconds fits_{0}, wait_ = kWait, sinceRise_ = kCalm;

    static constexpr std::chrono::nanoseconds kSlowest = std::chrono::milliseconds(40);  // of 50
    static constexpr std::chrono::nanoseconds kWait = std::chrono::milliseconds(500),
                                              kLongestWait = std::chrono::seconds(2),
                                              kCalm = std::chrono::seconds(10);
    static constexpr unsigned kPatience = 12, kMostPatience = 2048;
};

}  // namespace app
