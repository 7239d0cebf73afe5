#include "app/drawing/canvas_state.h"

#include <algorithm>
#include <utility>

#include "render/frame/mean_depth.h"
#include "render/reference/cell_pick.h"

namespace app {
namespace {

std::uint64_t drawnSplats(const std::vector<render::Layer>& layers, std::uint32_t stride) {
    std::uint64_t sum = 0;
    for (const render::Layer& layer : layers) sum += render::splatCount(layer, stride);
    return sum;
}

}  // namespace

Canvas::State::Moving Canvas::State::moving(const render::Scene& whole,
                                            std::span<const render::View> eyes,
                                            const CanvasLimits& limits) const {
    const bool hasCells = whole.cells != nullptr;
    const bool hasPoints = !hasCells || isThere(*screen->held, byPoints(whole));
    std::vector<Rung> rungs = ladder({.cells = hasCells && !listsForLong(whole),
                                      .points = hasPoints,
                                      .coarse = limits.mayBeCoarse,
                                      .coarsePoints = mayBeCoarse(whole.footprint),
                                      .mostStride = render::kMaxStride});
    if (limits.most) rungs = from(*limits.most, std::move(rungs));
    auto [on, gives] = rungInTime(rungs, {rung, gaveWay}, hasCells, limits,
                                  [&](const CanvasLimits& budgets, const Rung& each, double share) {
                                      return keepsTo(budgets, sceneOn(each, whole),
                                                     render::coarser(eyes, each.across), share);
                                  });
    if (!hasCells) on.model = Model::Points;
    if (on.model == Model::Points && !mayBeCoarse(whole.footprint)) on.across = 1;
    if (on.model == Model::Points && !hasPoints) on = {};
    return {on, sceneOn(on, whole), gives};
}

void Canvas::State::choose(const Explorer& choices) {
    Screen changed = *screen;
    changed.explorer = choices;
    if (!isThere(*changed.held, sceneOf(changed))) return;
    if (!changed.held->place(placesOf(choices))) {  // the other globe is to come
        changed.explorer.map = changed.held->places.map;
        changed.explorer.scale = changed.held->places.scale;
    }
    screen = std::move(changed);
}

GlSteps::Held& Canvas::State::bring(const Shown& shown, const CanvasLimits& limits,
                                    std::span<const render::View> moving, CanvasReport& report) {
    GlSteps::Held& held = steps.use(shown.sorted, placesOf(shown.explorer));
    Screen next{shown.sorted, &held, shown.explorer, shown.dataset.variable, shown.step};
    const render::Scene scene = sceneOf(next);
    const bool onScreen = screen && screen->held == &held;
    const bool waits = turns(held.places) && !isWhollyThere(held, scene);
    // While the picture moves, points may stand for cells.
    const render::Scene points = byPoints(scene);
    if (renderer.splatters().takesPointsFromGpu(points)) {
        std::optional<render::ValueScale> scale = render::neededScale(points);
        if (scale) scale = held.onGpu.serving(*scale);
        constexpr std::uint64_t kOnScreen = 8;
        const std::uint64_t before = waits ? held.onGpu.missingBytes(points, scale) : 0;
        held.onGpu.upload(points, scale, (onScreen ? kOnScreen : 1) * limits.uploadBytes);
        const std::uint64_t missing = waits ? before : held.onGpu.missingBytes(points, scale);
        if (missing > 0)
            report.uploaded =
                1 - static_cast<double>(missing) /
                        static_cast<double>(render::GlStep::neededBytes(points, scale));
    }
    const bool mayMove = isThere(held, points) || keepsTo(limits, scene, moving);
    if (isThere(held, scene) && mayMove && !waits) {
        screen.emplace(std::move(next));
    } else if (onScreen) {
        screen->explorer.scale = shown.explorer.scale;  // which use() has taken over
    } else if (screen && sameData(screen->explorer, shown.explorer)) {
        choose(shown.explorer);
    }
    return held;
}

render::Outline Canvas::State::outline(const Shown& shown) {
    const GlSteps::Places asked = placesOf(shown.explorer);
    if (!turns(asked)) return steps.outline(shown.sorted, asked);
    GlSteps::Held& held = steps.use(shown.sorted, asked);
    const Screen next{shown.sorted, &held, shown.explorer, shown.dataset.variable, shown.step};
    return (isWhollyThere(held, sceneOf(next)) ? held : *screen->held).placed.outline();
}

CanvasReport Canvas::State::begin(const Shown& shown, const CanvasLimits& limits,
                                  std::span<const render::View> moving, render::gl::Timer& of) {
    CanvasReport report;
    const GlSteps::Held& coming = bring(shown, limits, moving, report);
    steps.trim(limits.cacheBytes, screen ? screen->held : nullptr, &coming);
    report.gpuBytes = steps.bytes() + renderer.splatters().bytes();
    if (const auto timed = of.poll()) {
        report.gpuTime = timed->took;
        report.gpuSplats = timed->label >> 1;
        report.gpuCells = timed->label & 1;
    }
    if (!screen) return report;
    report.step = screen->step;
    cells.want(*screen);
    return report;
}

void Canvas::State::tell(CanvasReport& report, const render::Scene& scene) const {
    report.selected = drawnSplats(scene.layers, 1);
    report.counts = pointCounts(screen->explorer, *screen->sorted);
    report.stride = rung.stride;
    report.across = rung.across;
    report.drawn = drawnSplats(scene.layers, rung.stride);
    if (scene.cells && rung.model == Model::Cells) {
        report.cells = cellCount(scene, render::Channels::Over, 0);
        for (const render::Layer& layer : scene.layers)
            if (layer.byPoints) report.besideCells += render::pointCount(layer);
    }
    report.mixesColors = render::mixesColors(scene);
    report.lacksCells = lacksCells(scene);
    report.lacksGradients = scene.cells && !scene.gradients && !cells.gaveUp(*screen->sorted) &&
                            needsGradients(screen->explorer, *screen->sorted, scene.placed);
    report.whole = rung.isWhole() && report.uploaded == 1 && !report.lacks();
}

std::optional<render::Picked> Canvas::State::pick(const render::View& eye,
                                                  const glm::dvec2& window) const {
    const render::Scene scene = sceneOf(*screen);
    if (scene.cells && rung.model == Model::Cells) return render::pickCell(scene, eye, window);
    return render::pick(sceneOn({Model::Points, rung.stride}, scene), eye, window);
}

}  // namespace app
