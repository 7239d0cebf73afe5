#include "app/canvas.h"

#include "app/camera.h"
#include "app/still.h"

namespace app {
namespace {

// A step on the GPU, and where it is drawn.
struct Held {
    Held(std::shared_ptr<const timeseries::SortedStep> step, std::optional<glm::dvec3> stretch)
        : sorted(std::move(step)),
          scale(stretch),
          lattice(sorted->grid(), scale),
          onGpu(*sorted, lattice) {}
    std::shared_ptr<const timeseries::SortedStep> sorted;
    std::optional<glm::dvec3> scale;
    render::Lattice lattice;
    render::GpuStep onGpu;
};

}  // namespace

struct Canvas::State {
    Held& hold(const Shown& shown) {
        if (!held || held->sorted != shown.sorted || held->scale != shown.explorer.scale) {
            held.reset();
            held.emplace(shown.sorted, shown.explorer.scale);
        }
        return *held;
    }

    render::FrameRenderer renderer;
    std::optional<Held> held;
};

Canvas::Canvas() : state_(std::make_unique<State>()) {}
Canvas::~Canvas() = default;

CanvasReport Canvas::draw(
    const Shown& shown, std::span<const render::View> eyes, const CanvasLimits&, bool,
    const std::function<void(std::size_t eye, const render::Targets&)>& show) {
    Held& held = state_->hold(shown);
    const Explorer& e = shown.explorer;
    const Picture picture =
        makePicture(e, shown.dataset.about, shown.step, *held.sorted, held.lattice, e.play.tick);
    CanvasReport report;
    report.step = shown.step;
    for (const render::Layer& layer : picture.scene.layers)
        for (const timeseries::Run& run : layer.runs) report.selected += run.count;
    report.drawn = report.selected;
    const render::FrameContent content{picture.scene, held.sorted->grid(), picture.legend,
                                       kBackground};
    const auto frame = state_->renderer.prepare(content, held.onGpu, eyes);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        state_->renderer.drawEye(frame, eyes[i]);
        show(i, state_->renderer.targets());
    }
    report.gpuBytes = held.onGpu.bytes();
    return report;
}

std::vector<render::View> Canvas::eyesOf(const Shown& shown) const {
    const Explorer& e = shown.explorer;
    return eyes(e.view, e.stereo, render::Lattice(shown.sorted->grid(), e.scale).boxHalf(), e.size);
}

const render::Lattice* Canvas::lattice() const {
    return state_->held ? &state_->held->lattice : nullptr;
}

void Canvas::save(const Shown& shown, const std::filesystem::path& file) {
    Held& held = state_->hold(shown);
    writeStill({shown.explorer, shown.dataset.about, shown.step, *held.sorted, held.lattice,
                shown.explorer.play.tick},
               state_->renderer, held.onGpu, {}, file);
}

}  // namespace app
