#include "app/drawing/moving_rung.h"

#include <limits>
#include <optional>

namespace app {

render::Scene byPoints(render::Scene scene) {
    if (!scene.cells) return scene;
    scene.cells.reset();
    scene.light = render::Light::Off;
    if (render::areOneColor(scene.layers)) scene.order = render::Order::None;
    return scene;
}

render::Scene sceneOn(const Rung& rung, const render::Scene& whole) {
    if (rung.model == Model::Cells) return whole;
    render::Scene points = byPoints(whole);
    points.stride = rung.stride;
    points.footprint = standingFor(points.footprint, rung.stride);
    return points;
}

bool showsNothing(const Rung& rung, bool ofCells, const DepthErrors* errors) {
    constexpr double kFarOff = 0.5;
    if (const auto known = errors ? errors->of(rung) : std::nullopt) return *known > kFarOff;
    return ofCells && rung.model == Model::Points && rung.stride > 1;
}

Rung truestThatFits(std::span<const Rung> rungs, const Rung& last, const DepthErrors* errors,
                    const std::function<bool(const Rung&, double)>& fits) {
    std::optional<Rung> best;
    double least = std::numeric_limits<double>::infinity();
    for (const Rung& each : rungs) {
        const double error = errors ? errors->of(each).value_or(least) : least;
        if (best && !(error < least)) continue;
        if (!fits(each, drawsLess(last, each) ? kToClimb : 1)) continue;
        best = each;
        least = error;
        if (!errors) break;
    }
    return best.value_or(rungs.empty() ? Rung() : rungs.back());
}

}  // namespace app
