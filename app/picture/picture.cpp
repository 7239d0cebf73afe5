#include "app/picture/picture.h"

#include <algorithm>
#include <iterator>

#include "app/choices/camera.h"
#include "app/picture/resolved.h"
#include "render/frame/mean_depth.h"
#include "render/image/color.h"

namespace app {
namespace {

using timeseries::RangeSet;
using timeseries::SortedStep;

render::RangeStyle rangeStyle(const LayerChoice& layer) {
    const double opacity = layer.opacity.value();
    if (const auto* rgb = std::get_if<glm::dvec3>(&*layer.color))
        return {render::Constant{render::linearFromSrgb(*rgb)}, opacity};
    return {byValue(std::get<MapChoice>(*layer.color)), opacity};
}

}  // namespace

RangeSet rangesAt(const LayerChoice& layer, const SortedStep& step, std::int64_t tick) {
    if (!layer.motion) return layer.ranges;
    return step.keptPart(RangeSet(std::vector{timeseries::ValueSweep(*layer.motion).window(tick)}));
}

Explorer onlyThis(const Explorer& explorer, std::size_t stepIndex, std::int64_t tick) {
    Explorer e = explorer;
    e.steps = StepChoice{stepIndex, stepIndex};
    e.oneTick = sweepOf(e) != nullptr;
    if (e.oneTick) e.play.tick = tick;
    return e;
}

std::vector<timeseries::Interval<double>> cellsNeeded(const Explorer& e,
                                                      timeseries::ValueType type) {
    std::vector<timeseries::Interval<double>> all;
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible || modelOf(e, layer) == Model::Points) continue;
        if (layer.motion) return {timeseries::kAllNumbers};
        std::ranges::copy(timeseries::betweenPoints(layer.ranges, type), std::back_inserter(all));
    }
    return all;
}

namespace {

// One layer of points: its field has no slope out of it, and faces nobody.
bool isSheet(const timeseries::Grid& grid) {
    const auto& mesh = grid.mesh();
    return (!mesh || mesh->hasNeighbours()) && std::ranges::count(grid.size(), 1u) > 0;
}

// Cells, if they are drawn.
bool isLit(const Explorer& e, const timeseries::Grid& grid) {
    return e.light != render::Light::Off && e.order == render::Order::BackToFront && !isSheet(grid);
}

}  // namespace

bool needsGradients(const Explorer& e, const SortedStep& step, const render::PlacedPoints& placed) {
    return placed.isMesh() && isLit(e, step.grid()) && needsCells(e, step);
}

bool needsCells(const Explorer& e, const SortedStep& step) {
    return modelOf(e) == Model::Cells && step.canHaveCells() && !step.cellsAreGivenUp();
}

render::Scene makeScene(const Explorer& e, const SortedStep& step,
                        const render::PlacedPoints& placed, std::int64_t tick, Await await) {
    render::Scene scene{.step = step,
                        .placed = placed,
                        .layers = {},
                        .footprint = e.footprint,
                        .order = e.order,
                        .clip = {}};
    if (e.clip) scene.clip = render::indexBox(step.grid(), e.clip->lo, e.clip->hi);
    if (needsCells(e, step)) {
        const auto needed = cellsNeeded(e, step.type());
        scene.cells = await == Await::Cells ? step.cells(needed) : step.cellsIfMade(needed);
    }
    if (scene.cells && isLit(e, step.grid())) scene.light = e.light;
    if (scene.cells && placed.isMesh() && isLit(e, step.grid()))
        scene.gradients = await == Await::Cells ? step.gradients(placed.mesh())
                                                : step.gradientsIfMade(placed.mesh());
    if (e.lamp) scene.lamp = directionOf(e.lamp->azimuthDegrees, e.lamp->elevationDegrees);
    scene.opacityPer = e.opacityPer;
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible) continue;
        const RangeSet ranges = rangesAt(layer, step, tick);
        scene.layers.push_back({step.select(ranges), rangeStyle(layer)});
        const bool byCells = modelOf(e, layer) == Model::Cells;
        scene.layers.back().byPoints = scene.cells && !byCells;
        render::Cells& cells = scene.layers.back().cells;
        cells.ranges = timeseries::betweenPoints(ranges, step.type());
        if (scene.cells && byCells) cells.candidates = scene.cells->select(cells.ranges);
    }
    // The same picture without it.
    if (scene.light == render::Light::Off && render::areOneColor(scene.layers))
        scene.order = render::Order::None;
    return scene;
}

bool isMixed(const Explorer& e, const render::Scene& scene) {
    return render::isMixed(scene, eyes(e, scene.placed.outline()).front());
}

render::Legend asDrawn(const Explorer& e, render::Legend legend) {
    return e.legend ? std::move(legend) : render::Legend{};
}

Picture makePicture(const Explorer& e, const timeseries::Variable& variable, std::size_t stepIndex,
                    const SortedStep& step, const render::PlacedPoints& placed, std::int64_t tick) {
    render::Scene scene = makeScene(e, step, placed, tick);
    render::Legend legend = makeLegend(e, variable, stepIndex, scene, tick);
    return {std::move(scene), std::move(legend)};
}

}  // namespace app
