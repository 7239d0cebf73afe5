// What the eyes see: the volume, and placards around it, drawn into the headset's images so that
// the frame loop keeps the runtime's pace.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/canvas.h"
#include "render/frame_pace.h"
#include "render/present.h"
#include "xr/refresh_rate.h"
#include "xr/render_scale.h"
#include "xr/session.h"

namespace app::headset {

inline constexpr double kNear = 0.05, kFar = 100;  // metres

// An eye as drawing code knows it.
render::View viewOf(const xr::Eye& eye, const xr::Placement& placement);

// Needs a current GL context, from construction to destruction.
class Eyes {
 public:
    // `refreshRates`: those that the display offers.
    explicit Eyes(std::vector<double> refreshRates = {}) : rate_(std::move(refreshRates)) {}

    // Draws all eyes, of any sizes; none is left untouched. What an eye does not see of its image
    // becomes black. `shown`: null while there is nothing. `period`: the
    // runtime's; fewer splats are drawn where it would not be kept, or all of them without one.
    // `mirror` gets the first eye's light.
    void draw(const Shown* shown, std::span<const xr::Eye> eyes, const xr::Placement& placement,
              std::span<const render::Placard> placards,
              std::optional<std::chrono::nanoseconds> period,
              const std::function<void(const render::Targets&)>& mirror = {});
    // After a frame: what drawing took on this side of the driver. Where the GPU tells a longer
    // time, that counts.
    void took(std::chrono::nanoseconds frame, std::chrono::nanoseconds period);

    double scale() const { return scale_.scale(); }  // of the recommended resolution
    const xr::RefreshRate& refreshRate() const { return rate_; }
    Canvas& canvas() { return canvas_; }
    const render::Present& present() const { return present_; }
    const CanvasReport& report() const { return report_; }

 private:
    Canvas canvas_;
    render::Present present_;
    render::FramePace pace_{std::chrono::milliseconds(8)};
    xr::RenderScale scale_;
    xr::RefreshRate rate_;
    CanvasReport report_;
};

}  // namespace app::headset
