#include "app/drawing/canvas.h"

#include <algorithm>
#include <cmath>

#include "app/choices/camera.h"
#include "app/drawing/canvas_state.h"
#include "app/exploration/reading.h"
#include "app/picture/still.h"

namespace app {
namespace {

// What a timer keeps of what it times.
std::uint64_t labelOf(std::uint64_t cost, const render::Scene& drawn) {
    return cost << 1 | (drawn.cells ? 1 : 0);
}

}  // namespace

Canvas::Canvas(render::SplatterChoice splatter, render::LightAs as)
    : state_(std::make_unique<State>(splatter, as)) {}
Canvas::~Canvas() = default;

CanvasReport Canvas::draw(const Shown& shown, std::span<const render::View> eyes,
                          const CanvasLimits& limits, bool moving, const Show& show,
                          const CanvasScene& scene) {
    state_->resting.reset();
    state_->lacksOnlyGradients = false;
    CanvasReport report = state_->begin(
        shown, limits, moving ? eyes : std::span<const render::View>(), state_->timer);
    auto& screen = state_->screen;
    if (!screen) return report;

    render::Scene whole = moving ? state_->asHeld(sceneOf(*screen)) : sceneOf(*screen);
    whole.byMiddles = state_->isByMiddles(whole, moving);
    render::Legend legend;
    if (scene.legend) {
        legend = state_->telling.legend(*screen, whole, !moving);
        report.told = state_->telling.isOf(*screen, whole);
    }
    const auto [rung, drawn, gaveWay] =
        moving ? state_->moving(whole, eyes, limits) : State::Moving{rungOf(whole), whole};
    if (!drawn.cells) std::erase_if(legend.notes, isOfCells);
    state_->rung = rung;
    state_->gaveWay = gaveWay;
    state_->tell(report, drawn);

    state_->timer.begin();
    const render::FrameContent content{drawn,
                                       screen->sorted->grid(),
                                       asDrawn(screen->explorer, std::move(legend)),
                                       kBackground,
                                       rung.across,
                                       scene.placards};
    const auto frame = state_->renderer.prepare(content, screen->held->onGpu, eyes);
    double cost = 0;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        cost += state_->renderer.drawEye(frame, eyes[i]);
        show(i, state_->renderer.targets());
    }
    report.cost = static_cast<std::uint64_t>(std::llround(cost));
    report.planesCost = state_->planesCost(drawn, render::coarser(eyes, rung.across));
    state_->timer.end(labelOf(report.cost, drawn));
    return report;
}

SubsetCosts Canvas::subsetCosts(const CanvasReport& of, std::span<const render::View> eyes) const {
    if (!state_->screen) return {};
    const render::Scene whole = sceneOf(*state_->screen);
    const Rung& rung = state_->rung;
    const std::vector<render::View> planes = render::coarser(eyes, rung.across);
    const auto costAt = [&](std::uint32_t stride) {
        const render::Scene subset = sceneOn({Model::Points, stride, rung.across}, whole);
        const double splats = state_->costOf(subset, planes);
        return of.planesCost + static_cast<std::uint64_t>(std::llround(splats));
    };
    SubsetCosts costs{.least = std::min(of.cost, costAt(render::kMaxStride))};
    if (!whole.cells && rung.stride > 1) costs.finer = std::max(of.cost, costAt(rung.stride / 2));
    return costs;
}

CanvasReport Canvas::refine(const Shown& shown, std::span<const render::View> eyes,
                            const CanvasLimits& limits, const Show& show) {
    CanvasReport report = state_->begin(shown, limits, {}, state_->refineTimer);
    auto& screen = state_->screen;
    if (!screen) return report;
    auto& resting = state_->resting;
    if (!resting || !resting->is(*screen, eyes)) {
        render::Scene scene = sceneOf(*screen);
        scene.byMiddles = state_->isByMiddles(scene, false);
        render::Legend legend = state_->telling.legend(*screen, scene, true);
        const bool atOnce = state_->keepsTo(limits, scene, eyes);
        resting.emplace(state_->renderer, state_->order, *screen,
                        Picture{std::move(scene), asDrawn(screen->explorer, std::move(legend))},
                        eyes, atOnce);
    }
    Refinement& refinement = resting->refinement;
    if (refinement.order()) {
        state_->refineTimer.begin();
        const auto limit = static_cast<double>(limits.of(refinement.scene()));
        report.cost = static_cast<std::uint64_t>(refinement.goOn(limit, show));
        state_->refineTimer.end(labelOf(report.cost, refinement.scene()));
    }
    const bool done = refinement.done();
    if (done) {
        state_->rung = rungOf(refinement.scene());
    }
    state_->tell(report, refinement.scene());
    // Until they are there nothing is left to refine.
    report.refined = done && report.lacks() ? 0 : refinement.share();
    state_->lacksOnlyGradients = done && report.lacksGradients && !report.lacksCells;
    report.whole = report.whole && done;
    if (done) resting.reset();
    return report;
}

bool Canvas::waitsForGradients() {
    const auto& screen = state_->screen;
    if (!screen || !state_->lacksOnlyGradients) return false;
    state_->cells.want(*screen);
    return !screen->sorted->gradientsIfMade(screen->held->placed.mesh());
}

void Canvas::drawPlacards(std::span<const render::Placard> placards,
                          std::span<const render::View> eyes, const Show& show) {
    state_->resting.reset();
    state_->renderer.drawPlacards(placards, kBackground, eyes, show);
}

std::vector<render::View> Canvas::eyesOf(const Shown& shown) const {
    return eyes(shown.explorer, state_->outline(shown));
}

bool Canvas::shows(const Explorer& data) const {
    return state_->screen && sameData(state_->screen->explorer, data);
}

std::optional<Drawn> Canvas::drawn() const {
    if (!state_->screen) return std::nullopt;
    return Drawn{&state_->screen->held->placed, state_->screen->sorted, state_->screen->step};
}

const Screen* Canvas::screen() const { return state_->screen ? &*state_->screen : nullptr; }

std::optional<Probe> Canvas::probe(const render::View& eye, const glm::dvec2& window) const {
    if (!state_->screen) return std::nullopt;
    const std::optional<render::Picked> picked = state_->pick(eye, window);
    if (!picked) return std::nullopt;
    const timeseries::SortedStep& step = *state_->screen->sorted;
    const std::uint64_t i = picked->gridIndex;
    const auto at = step.grid().indices(i);
    const std::array<std::size_t, 3> index{at.x, at.y, at.z};
    return Probe{*picked, step.grid().position(i), index, cellText(step.grid(), index)};
}

void Canvas::save(const Shown& shown, const std::filesystem::path& file,
                  const std::optional<double>& error) {
    state_->resting.reset();
    GlSteps::Held& held = state_->steps.use(shown.sorted, placesOf(shown.explorer));
    write(drawStill({.explorer = shown.explorer,
                     .variable = shown.dataset.variable,
                     .stepIndex = shown.step,
                     .step = *shown.sorted,
                     .placed = held.placed,
                     .tick = shown.explorer.play.tick,
                     .error = error},
                    state_->renderer, held.onGpu, {}, file));
}

}  // namespace app
