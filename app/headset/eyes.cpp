#include "app/headset/eyes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace app::headset {
namespace {

// Of the period: what the volume may take. The rest is for the panel, the mirror and the runtime.
constexpr double kShare = 0.7;

std::chrono::nanoseconds share(std::chrono::nanoseconds period) {
    return std::chrono::nanoseconds(std::llround(kShare * static_cast<double>(period.count())));
}

}  // namespace

render::View viewOf(const xr::Eye& eye, const xr::Placement& placement) {
    render::View view = xr::viewOf(eye.stageFromEye, eye.fov, placement, kNear, kFar, eye.size);
    view.hidden = eye.hidden;
    return view;
}

void Eyes::draw(const Shown* shown, std::span<const xr::Eye> eyes, const xr::Placement& placement,
                std::span<const render::Placard> placards,
                std::optional<std::chrono::nanoseconds> period,
                const std::function<void(const render::Targets&)>& mirror) {
    std::vector<render::View> views;
    for (const xr::Eye& eye : eyes) views.push_back(viewOf(eye, placement));
    bool drawn = false;
    const auto show = [&](std::size_t eye, const render::Targets& light) {
        present_.draw(light, eyes[eye].framebuffer, {0, 0}, render::Encoding::Framebuffer);
        if (eye == 0 && mirror) mirror(light);
        drawn = true;
    };
    report_ = {};
    if (shown != nullptr) {
        if (period) pace_.setTarget(share(*period));
        report_ = canvas_.draw(*shown, views, {.splats = pace_.budget()}, period.has_value(), show,
                               {.legend = false, .placards = placards});
    }
    if (!drawn) canvas_.drawPlacards(placards, views, show);
}

void Eyes::took(std::chrono::nanoseconds frame, std::chrono::nanoseconds period) {
    if (report_.gpuTime) {
        pace_.took(report_.gpuSplats, *report_.gpuTime);
        frame = std::max(frame, *report_.gpuTime);
    }
    scale_.took(frame, period);
    // Where not all splats are drawn, those that are fill what draw() lets them have.
    const bool fits = report_.gpuTime && !report_.whole;
    rate_.took(frame, scale_, fits ? *report_.gpuTime : std::chrono::nanoseconds(0));
}

}  // namespace app::headset
