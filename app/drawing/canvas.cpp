#include "app/drawing/canvas.h"

#include <algorithm>

#include "app/choices/camera.h"
#include "app/drawing/cell_maker.h"
#include "app/drawing/gl_steps.h"
#include "app/drawing/moving_rung.h"
#include "app/drawing/resting.h"
#include "app/drawing/screen.h"
#include "app/drawing/telling.h"
#include "app/exploration/reading.h"
#include "app/picture/still.h"
#include "render/frame/frame_pace.h"
#include "render/frame/mean_depth.h"
#include "render/gl/timer.h"
#include "render/reference/cell_pick.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/gl_tets.h"

namespace app {
namespace {

std::uint64_t drawnSplats(const std::vector<render::Layer>& layers, std::uint32_t stride) {
    std::uint64_t sum = 0;
    for (const render::Layer& layer : layers) sum += render::splatCount(layer, stride);
    return sum;
}

GlSteps::Places placesOf(const Explorer& e) { return {e.scale, e.map}; }

// What a timer keeps of what it times.
std::uint64_t labelOf(std::uint64_t cost, const render::Scene& drawn) {
    return cost << 1 | (drawn.cells ? 1 : 0);
}

}  // namespace

struct Canvas::State {
    State(render::SplatterChoice splatter, render::LightAs as) : renderer(splatter, as) {}

    render::FrameRenderer renderer;
    render::gl::Timer timer, refineTimer;
    GlSteps steps;
    CellMaker cells;
    std::optional<Screen> screen;
    Rung rung{Model::Points};         // of what was shown last,
    bool gaveWay = false;             // and whether beyond the pace
    render::DepthOrder order;         // of pictures at rest
    std::optional<Resting> resting;   // uses the renderer alone
    bool lacksOnlyGradients = false;  // what was refined last
    Telling telling;

    // What every frame begins with: brings what is shown and tells of it. `moving`: the eyes for
    // which the limits hold.
    CanvasReport begin(const Shown& shown, const CanvasLimits& limits,
                       std::span<const render::View> moving, render::gl::Timer& of);
    // What planes cost anyhow is taken from the limit, but of few splats nothing. `share`: of the
    // limit.
    bool keepsTo(const CanvasLimits& limits, const render::Scene& scene,
                 std::span<const render::View> eyes, double share = 1) const {
        const std::uint64_t limit = limits.of(scene), planes = planesCost(scene, eyes);
        const std::uint64_t least = std::min(limit, render::FramePace::kFewest);
        return costOf(scene, eyes) <=
               share * static_cast<double>(std::max(limit - std::min(limit, planes), least));
    }
    double costOf(const render::Scene& scene, std::span<const render::View> eyes) const {
        double sum = 0;
        for (const render::View& eye : eyes) sum += renderer.splatsCost(scene, eye);
        return sum;
    }
    std::uint64_t planesCost(const render::Scene& scene, std::span<const render::View> eyes) const {
        double sum = 0;
        for (const render::View& eye : eyes) sum += renderer.planesCost(scene, eye);
        return static_cast<std::uint64_t>(std::llround(sum));
    }
    // For a picture that moves: the rung that it is drawn on (app/choices/rung.h), and what is
    // drawn there.
    struct Moving {
        Rung rung;
        render::Scene scene;
        bool gaveWay = false;  // beyond the pace
    };
    Moving moving(const render::Scene& whole, std::span<const render::View> eyes,
                  const CanvasLimits& limits) const;
    // Uploads a slice of what is shown and, once all that it selects is there, puts it on the
    // screen. Returns the step shown.
    GlSteps::Held& bring(const Shown& shown, const CanvasLimits& limits,
                         std::span<const render::View> moving, CanvasReport& report);
    // Of what the next frame has on the screen.
    render::Outline outline(const Shown& shown);
    // The step on the screen takes other choices, if all that they select is there to be drawn.
    void choose(const Explorer& choices);
    bool isThere(const GlSteps::Held& held, const render::Scene& scene) const {
        return !renderer.splatters().takesPointsFromGpu(scene) || held.onGpu.ready(scene);
    }
    // Whether what is shown is to lie otherwise than what is on the screen, of which the eyes are
    // until all that the other may be drawn by is there.
    bool turns(const GlSteps::Places& asked) const {
        return screen && screen->held->places.map != asked.map;
    }
    bool isWhollyThere(const GlSteps::Held& held, const render::Scene& scene) const {
        return isThere(held, scene) && isThere(held, byPoints(scene));
    }
    // Tetrahedra for GL are listed by the processor in one go when the selection changes: so many
    // in 50 ms on two cores (tests/bench/NOTES.md).
    bool listsForLong(const render::Scene& scene) const {
        constexpr std::uint64_t kMost = sizeof(render::GlTet) << 17;
        const render::Splatters& splatters = renderer.splatters();
        return scene.cells && scene.placed.isMesh() && splatters.sumsByGl(scene) &&
               !splatters.holdsCells(scene) && render::GlPieces::bytesOf(scene) > kMost;
    }
    // Whether cells of a mesh come by their middles. Few are put in order in 5 ms; GL's by the
    // processor, in one go and for each eye, which its frames have no time for.
    bool isByMiddles(const render::Scene& scene, bool moving) const {
        constexpr std::uint64_t kFew = 1 << 14, kMostOfGl = 1 << 16;
        const std::uint64_t count = render::cellCount(scene, render::Channels::Over, 0);
        const bool byGl = renderer.splatters().sumsByGl(scene);
        return moving ? byGl || count > kFew : byGl && count > kMostOfGl;
    }
    // While GL holds a mesh's tetrahedra as they were before there were gradients, and to list them
    // anew takes long: so.
    render::Scene asHeld(const render::Scene& scene) const {
        render::Scene before = scene;
        before.gradients = nullptr;
        return listsForLong(scene) && renderer.splatters().holdsCells(before) ? before : scene;
    }
    // What stands there in what was shown last.
    std::optional<render::Picked> pick(const render::View& eye, const glm::dvec2& window) const;
    // What of the scene is on the screen.
    void tell(CanvasReport& report, const render::Scene& scene) const;
    // Whether what is to be drawn by cells is drawn by points.
    bool lacksCells(const render::Scene& drawn) const {
        return !drawn.cells && needsCells(screen->explorer, *screen->sorted);
    }
};

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

Canvas::Canvas(render::SplatterChoice splatter, render::LightAs as)
    : state_(std::make_unique<State>(splatter, as)) {}
Canvas::~Canvas() = default;

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

std::optional<render::Picked> Canvas::State::pick(const render::View& eye,
                                                  const glm::dvec2& window) const {
    const render::Scene scene = sceneOf(*screen);
    if (scene.cells && rung.model == Model::Cells) return render::pickCell(scene, eye, window);
    return render::pick(sceneOn({Model::Points, rung.stride}, scene), eye, window);
}

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
