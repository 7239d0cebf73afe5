#include "app/drawing/picture_error.h"

#include <atomic>
#include <limits>
#include <system_error>
#include <thread>

#include "app/picture/picture.h"
#include "render/reference/sampled_error.h"
#include "render/splat/memory_targets.h"
#include "render/splat/processor_splatter.h"

namespace app {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Of all layers together, [y][x], row 0 at the bottom; none once nobody wants it.
std::vector<float> opticalDepth(const render::Scene& scene, const render::View& view,
                                const std::atomic<bool>& wanted) {
    constexpr std::uint64_t kAtOnce = 1 << 15;  // a few milliseconds
    render::MemoryTargets targets(view.size);
    render::ProcessorSplatter splatter;
    const auto splats =
        splatter.prepare(scene, render::Runs{}, render::GpuStep(scene.step, scene.placed));
    std::vector<float> depth(static_cast<std::size_t>(view.size.x) *
                             static_cast<std::size_t>(view.size.y));
    for (std::size_t k = 0; k < scene.layers.size(); ++k) {
        const auto sum = splats->begin(view, render::Channels::Weight, k, targets);
        while (!sum->done()) {
            if (!wanted) return {};
            sum->add(kAtOnce);
        }
        const auto perWeight =
            static_cast<float>(render::opticalDepthPerWeight(scene.layers[k].style.opacity));
        const std::vector<float> weight = render::turnedOver(targets.readScalarPlane(k), view.size);
        for (std::size_t i = 0; i < depth.size(); ++i) depth[i] += perWeight * weight[i];
    }
    return depth;
}

double errorOf(const PictureError::Picture& picture, const std::atomic<bool>& wanted) {
    const timeseries::SortedStep& step = *picture.sorted;
    const render::PlacedPoints placed(step.grid(), picture.explorer.scale);
    Explorer e = picture.explorer;
    e.opacityPer = render::OpacityPer::Length;
    e.order = render::Order::None;  // depth alone
    const render::Scene scene = makeScene(e, step, placed, e.play.tick);
    if (scene.layers.empty()) return kUnknown;
    const std::vector<float> depth = opticalDepth(scene, picture.view, wanted);
    if (!wanted) return kUnknown;
    const auto cells = step.cellsIfMade();
    const timeseries::Field field = cells ? timeseries::Field{} : fieldOf(step);
    // One thread: the interface has the others.
    return sampledError(scene, cells ? cells->field() : field, picture.view, depth, {.threads = 1})
        .relativeL2;
}

}  // namespace

// Its thread writes `error` and lets go of the step before it is done.
struct PictureError::Work {
    Picture picture;
    std::weak_ptr<const timeseries::SortedStep> sorted;
    double error = kUnknown;
    std::atomic<bool> wanted = true, done = false;

    bool isOf(const Picture& other) const {
        return sorted.lock() == other.sorted && picture.explorer == other.explorer &&
               picture.view == other.view;
    }
    void run() {
        try {
            error = errorOf(picture, wanted);
        } catch (...) {  // then it is not told: a picture is as good without
        }
        picture.sorted.reset();
        done = true;
    }
};

double PictureError::worked(const Picture& picture) {
    const std::atomic<bool> wanted = true;
    return errorOf(picture, wanted);
}

void PictureError::forget() {
    if (work_) work_->wanted = false;
}

std::optional<double> PictureError::of(const Picture& picture) {
    if (work_ && !work_->done) return std::nullopt;
    if (work_ && work_->wanted && work_->isOf(picture)) return work_->error;
    auto work = std::make_shared<Work>();
    work->picture = picture;
    work->sorted = picture.sorted;
    try {
        std::thread([work] { work->run(); }).detach();
    } catch (const std::system_error&) {  // no thread to be had
        return kUnknown;
    }
    work_ = std::move(work);
    return std::nullopt;
}

PictureError::~PictureError() { forget(); }

}  // namespace app
