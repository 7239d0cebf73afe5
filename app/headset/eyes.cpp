#include "app/headset/eyes.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "render/gl/driver.h"

namespace app::headset {

Eyes::Eyes(std::vector<double> refreshRates)
    : pace_(std::move(refreshRates)), onProcessor_(render::gl::drawsOnProcessor()) {}

render::View viewOf(const xr::Eye& eye, const xr::Placement& placement) {
    render::View view = xr::viewOf(eye.stageFromEye, eye.fov, placement, kNear, kFar, eye.size);
    view.hidden = eye.hidden;
    return view;
}

void Eyes::draw(const Shown* shown, std::span<const xr::Eye> eyes, const xr::Placement& placement,
                std::span<const render::Placard> placards, Splats splats,
                const std::function<void(render::Targets&)>& mirror, const DepthErrors* errors,
                const std::optional<Rung>& most) {
    eyes_ = eyes.size();
    std::vector<render::View> views;
    for (const xr::Eye& eye : eyes) views.push_back(viewOf(eye, placement));
    bool drawn = false;
    const auto show = [&](std::size_t eye, render::Targets& light) {
        present_.drawLinear(light, eyes[eye].framebuffer);
        if (eye == 0 && mirror) mirror(light);
        drawn = true;
    };
    report_ = {};
    CanvasLimits limits = pace_.governor().limits(errors);
    limits.most = most;
    subsets_ = {};
    if (shown != nullptr) {
        report_ = canvas_.draw(*shown, views, limits, splats == Splats::Governed, show,
                               {.legend = false, .placards = placards});
        subsets_ = canvas_.subsetCosts(report_, views);
    }
    if (!drawn) canvas_.drawPlacards(placards, views, show);
}

void Eyes::took(std::chrono::steady_clock::time_point began, std::chrono::nanoseconds period) {
    // A GPU goes on after the calls; what it took is told some frames later.
    if (onProcessor_) render::gl::finishDrawing();
    DisplayPace::FrameCost frame{period, std::chrono::steady_clock::now() - began, {}};
    const std::uint64_t fewest = subsets_.least;
    constexpr double kUnknown = 2;  // of a selection that grows
    const double finer =
        subsets_.finer > 0 && report_.cost > 0
            ? static_cast<double>(subsets_.finer) / static_cast<double>(report_.cost)
            : kUnknown;
    if (onProcessor_ && report_.cost > 0) {
        frame.splats = {report_.cost, fewest, frame.work, report_.cells.has_value(), finer};
    } else if (report_.gpuTime) {
        frame.splats = {report_.gpuSplats, fewest, *report_.gpuTime, report_.gpuCells, finer};
        frame.work = std::max(frame.work, *report_.gpuTime);
    }
    work_ = frame.work;
    pace_.took(frame);
}

}  // namespace app::headset
