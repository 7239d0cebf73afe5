#include "app/canvas.h"

#include <algorithm>
#include <cmath>

#include "app/camera.h"
#include "app/gpu_steps.h"
#include "app/refinement.h"
#include "app/still.h"
#include "render/gl/gpu_timer.h"

namespace app {
namespace {

std::uint64_t drawnSplats(const std::vector<render::Layer>& layers, std::uint32_t stride) {
    std::uint64_t sum = 0;
    for (const render::Layer& layer : layers) sum += render::splatCount(layer, stride);
    return sum;
}

// The least stride that keeps to the limit.
std::uint32_t strideFor(const std::vector<render::Layer>& layers, std::uint64_t limit) {
    std::uint32_t stride = 1;
    while (stride < render::kMaxStride && drawnSplats(layers, stride) > limit) stride *= 2;
    return stride;
}

// A splat of a subset fills the place of the points that it stands for: at equal cost that is
// nearer to the whole than more, smaller splats (tests/bench/canvas_bench.cpp). Points keep their
// pixels.
render::Footprint footprintFor(render::Footprint footprint, std::uint32_t stride) {
    if (footprint.kernel != render::Kernel::Point) footprint.size *= std::cbrt(stride);
    return footprint;
}

// What is drawn: a step, and choices of which all that they select is on the GPU.
struct Screen {
    std::shared_ptr<const timeseries::SortedStep> sorted;
    GpuSteps::Held* held;
    Explorer explorer;
    timeseries::Variable about;
    std::size_t step;
};

Picture pictureOf(const Screen& screen) {
    return makePicture(screen.explorer, screen.about, screen.step, *screen.sorted,
                       screen.held->lattice, screen.explorer.play.tick);
}

// Which layer of the explorer is the scene's k-th: hidden ones are not in the scene, and the swept
// window comes first.
std::optional<std::size_t> layerOf(const Explorer& e, std::size_t k) {
    if (e.sweep && e.sweepLayer.visible && k-- == 0) return std::nullopt;
    std::size_t layer = 0;
    while (!e.layers[layer].visible || k-- > 0) ++layer;
    return layer;
}

// What is on the screen, being refined.
struct Resting {
    Screen of;
    Refinement refinement;

    Resting(render::FrameRenderer& renderer, const Screen& screen,
            std::span<const render::View> eyes)
        : of(screen), refinement(renderer, pictureOf(screen), screen.held->onGpu, eyes) {}
    bool is(const Screen& screen, std::span<const render::View> eyes) const {
        return of.sorted == screen.sorted && of.explorer == screen.explorer &&
               std::ranges::equal(refinement.eyes(), eyes);
    }
};

}  // namespace

struct Canvas::State {
    render::FrameRenderer renderer;
    render::gl::GpuTimer timer, refineTimer;
    GpuSteps steps;
    std::optional<Screen> screen;
    std::uint32_t stride = 1;        // of what was shown last
    std::optional<Resting> resting;  // uses the renderer alone

    // What every frame begins with: brings what is shown and tells of it.
    CanvasReport begin(const Shown& shown, const CanvasLimits& limits, render::gl::GpuTimer& of);
    // Uploads a slice of what is shown and, once all that it selects is there, puts it on the
    // screen. Returns the step shown.
    GpuSteps::Held& bring(const Shown& shown, std::uint64_t uploadBytes, CanvasReport& report);
    // The step on the screen takes other choices, if all that they select is on the GPU.
    void choose(const Explorer& choices);
    // What of the layers is on the screen.
    void tell(CanvasReport& report, const std::vector<render::Layer>& layers) const;
};

void Canvas::State::choose(const Explorer& choices) {
    Screen changed = *screen;
    changed.explorer = choices;
    if (!changed.held->onGpu.ready(pictureOf(changed).scene)) return;
    changed.held->stretch(choices.scale);
    screen = std::move(changed);
}

GpuSteps::Held& Canvas::State::bring(const Shown& shown, std::uint64_t uploadBytes,
                                     CanvasReport& report) {
    GpuSteps::Held& held = steps.use(shown.sorted, shown.explorer.scale);
    Screen next{shown.sorted, &held, shown.explorer, shown.dataset.about, shown.step};
    const Picture picture = pictureOf(next);
    std::optional<render::ValueScale> scale = render::neededScale(picture.scene);
    if (scale) scale = held.onGpu.serving(*scale);
    const bool onScreen = screen && screen->held == &held;
    constexpr std::uint64_t kOnScreen = 8;
    held.onGpu.upload(picture.scene, scale, onScreen ? kOnScreen * uploadBytes : uploadBytes);
    if (const std::uint64_t missing = held.onGpu.missingBytes(picture.scene, scale); missing > 0)
        report.uploaded =
            1 - static_cast<double>(missing) /
                    static_cast<double>(render::GpuStep::neededBytes(picture.scene, scale));
    if (held.onGpu.ready(picture.scene)) {
        screen.emplace(std::move(next));
    } else if (onScreen) {
        screen->explorer.scale = shown.explorer.scale;  // which use() has taken over
    } else if (screen && sameData(screen->explorer, shown.explorer)) {
        choose(shown.explorer);
    }
    return held;
}

Canvas::Canvas() : state_(std::make_unique<State>()) {}
Canvas::~Canvas() = default;

CanvasReport Canvas::State::begin(const Shown& shown, const CanvasLimits& limits,
                                  render::gl::GpuTimer& of) {
    CanvasReport report;
    const GpuSteps::Held& coming = bring(shown, limits.uploadBytes, report);
    steps.trim(limits.cacheBytes, screen ? screen->held : nullptr, &coming);
    report.gpuBytes = steps.bytes();
    if (const auto timed = of.poll()) {
        report.gpuTime = timed->took;
        report.gpuSplats = timed->label;
    }
    if (screen) report.step = screen->step;
    return report;
}

void Canvas::State::tell(CanvasReport& report, const std::vector<render::Layer>& layers) const {
    report.selected = drawnSplats(layers, 1);
    report.stride = stride;
    report.drawn = drawnSplats(layers, stride);
    report.whole = stride == 1 && report.uploaded == 1;
}

CanvasReport Canvas::draw(const Shown& shown, std::span<const render::View> eyes,
                          const CanvasLimits& limits, bool moving, const Show& show,
                          const CanvasScene& scene) {
    state_->resting.reset();
    CanvasReport report = state_->begin(shown, limits, state_->timer);
    auto& screen = state_->screen;
    if (!screen) return report;

    Picture picture = pictureOf(*screen);
    if (moving) picture.scene.stride = strideFor(picture.scene.layers, limits.splats / eyes.size());
    picture.scene.footprint = footprintFor(screen->explorer.footprint, picture.scene.stride);
    state_->stride = picture.scene.stride;
    state_->tell(report, picture.scene.layers);

    state_->timer.begin();
    const render::FrameContent content{picture.scene, screen->sorted->grid(),
                                       scene.legend ? picture.legend : render::Legend{},
                                       kBackground, scene.placards};
    const auto frame = state_->renderer.prepare(content, screen->held->onGpu, eyes);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        state_->renderer.drawEye(frame, eyes[i]);
        show(i, state_->renderer.targets());
    }
    state_->timer.end(report.drawn * eyes.size());
    return report;
}

CanvasReport Canvas::refine(const Shown& shown, std::span<const render::View> eyes,
                            const CanvasLimits& limits, const Show& show) {
    CanvasReport report = state_->begin(shown, limits, state_->refineTimer);
    auto& screen = state_->screen;
    if (!screen) return report;
    auto& resting = state_->resting;
    if (!resting || !resting->is(*screen, eyes)) resting.emplace(state_->renderer, *screen, eyes);
    Refinement& refinement = resting->refinement;
    state_->refineTimer.begin();
    const std::uint64_t splats = refinement.goOn(limits.splats, show);
    state_->refineTimer.end(splats);
    const bool done = refinement.done();
    if (done) state_->stride = 1;
    state_->tell(report, refinement.scene().layers);
    report.refined = refinement.share();
    report.whole = report.whole && done;
    if (done) resting.reset();
    return report;
}

void Canvas::drawPlacards(std::span<const render::Placard> placards,
                          std::span<const render::View> eyes, const Show& show) {
    state_->resting.reset();
    state_->renderer.makeRoom(eyes);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        state_->renderer.drawPlacards(placards, kBackground, eyes[i]);
        show(i, state_->renderer.targets());
    }
}

std::vector<render::View> Canvas::eyesOf(const Shown& shown) const {
    const Explorer& e = shown.explorer;
    return eyes(e.view, e.stereo, render::Lattice(shown.sorted->grid(), e.scale).boxHalfEdges(),
                e.size);
}

bool Canvas::shows(const Explorer& data) const {
    return state_->screen && sameData(state_->screen->explorer, data);
}

std::optional<Drawn> Canvas::drawn() const {
    if (!state_->screen) return std::nullopt;
    return Drawn{&state_->screen->held->lattice, state_->screen->sorted, state_->screen->step};
}

std::optional<Probe> Canvas::probe(const render::View& eye, const glm::dvec2& window) const {
    if (!state_->screen) return std::nullopt;
    Picture picture = pictureOf(*state_->screen);
    picture.scene.stride = state_->stride;
    picture.scene.footprint =
        footprintFor(state_->screen->explorer.footprint, picture.scene.stride);
    const auto picked = render::pick(picture.scene, eye, window);
    if (!picked) return std::nullopt;
    const timeseries::SortedStep& step = *state_->screen->sorted;
    const auto size = step.grid().size();
    const std::uint64_t i = picked->gridIndex;
    return Probe{*picked,
                 layerOf(state_->screen->explorer, picked->layer),
                 step.value(picked->point),
                 step.grid().position(i),
                 {i % size[0], i / size[0] % size[1], i / size[0] / size[1]}};
}

void Canvas::save(const Shown& shown, const std::filesystem::path& file) {
    state_->resting.reset();
    GpuSteps::Held& held = state_->steps.use(shown.sorted, shown.explorer.scale);
    writeStill({shown.explorer, shown.dataset.about, shown.step, *shown.sorted, held.lattice,
                shown.explorer.play.tick},
               state_->renderer, held.onGpu, {}, file);
}

}  // namespace app
