// What the eyes see: the volume, and placards around it, drawn into the headset's images so that
// the frame loop keeps the runtime's pace.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/drawing/canvas.h"
#include "app/headset/display_pace.h"
#include "render/frame/present.h"
#include "xr/session.h"

namespace app::headset {

inline constexpr double kNear = 0.05, kFar = 100;  // metres

// An eye as drawing code knows it.
render::View viewOf(const xr::Eye& eye, const xr::Placement& placement);

// Needs a current GL context, from construction to destruction.
class Eyes {
 public:
    // `refreshRates`: those that the display offers.
    explicit Eyes(std::vector<double> refreshRates = {});

    // Draws all eyes, of any sizes; none is left untouched. What an eye does not see of its image
    // becomes black. `shown`: null while there is nothing. With `Splats::Governed`, no more of
    // them than keep the pace: of the ways to draw that fit the truest, by what `errors` knows of
    // them, which draws no more than `most`. `mirror` gets the first eye's light.
    enum class Splats { Governed, All };
    void draw(const Shown* shown, std::span<const xr::Eye> eyes, const xr::Placement& placement,
              std::span<const render::Placard> placards, Splats splats,
              const std::function<void(render::Targets&)>& mirror = {},
              const DepthErrors* errors = nullptr, const std::optional<Rung>& most = {});
    // All that is drawn for a frame is asked for, also what other parts of the program draw: it
    // began then, and the display's period is this.
    void took(std::chrono::steady_clock::time_point began, std::chrono::nanoseconds period);

    std::chrono::nanoseconds work() const { return work_; }  // of the last frame, with its GPU's
    double scale() const { return pace_.scale(); }           // of the recommended resolution
    const xr::RefreshRate& refreshRate() const { return pace_.refreshRate(); }
    // What another found drawing to cost here, so that the first frames already fit.
    void beginFrom(const DrawingCosts& learnt) { pace_.governor().beginFrom(learnt); }
    Canvas& canvas() { return canvas_; }
    const render::Present& present() const { return present_; }
    const CanvasReport& report() const { return report_; }

 private:
    Canvas canvas_;
    render::Present present_;
    DisplayPace pace_;
    bool onProcessor_;  // drawing is, so that its end can be waited for
    CanvasReport report_;
    SubsetCosts subsets_;
    std::chrono::nanoseconds work_{0};
    std::size_t eyes_ = 0;  // drawn last
};

}  // namespace app::headset
