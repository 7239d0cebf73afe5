#include "app/drawing/moving_rung.h"

#include <limits>
#include <optional>

namespace app {
namespace {

// Climbing wants room to spare: of a limit that swings about what a rung takes, the picture would
// change all the time.
constexpr double kToClimb = 0.8;

}  // namespace

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

PacedRung rungInTime(std::span<const Rung> rungs, const PacedRung& last, bool ofCells,
                     const CanvasLimits& limits,
                     const std::function<bool(const CanvasLimits&, const Rung&, double)>& fits) {
    if (limits.rung) return {*limits.rung};
    const auto truestWithin = [&](const CanvasLimits& budgets, double ofThem) {
        return truestThatFits(rungs, last.rung, limits.errors, [&](const Rung& on, double share) {
            return fits(budgets, on, ofThem * share);
        });
    };
    const Rung on = truestWithin(limits, last.gaveWay ? kToClimb : 1);  // back to the pace, too
    if (!limits.slower || !showsNothing(on, ofCells, limits.errors)) return {on};
    CanvasLimits slower = limits;
    slower.splats = limits.slower->splats;
    slower.cells = limits.slower->cells;
    return {truestWithin(slower, 1), true};
}

}  // namespace app
