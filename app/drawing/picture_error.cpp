#include "app/drawing/picture_error.h"

#include <atomic>
#include <limits>
#include <system_error>
#include <thread>

#include "app/picture/picture.h"
#include "render/frame/plain_frame.h"
#include "render/reference/sampled_error.h"

namespace app {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double errorOf(const PictureError::Picture& picture, const std::atomic<bool>& wanted) {
    const timeseries::SortedStep& step = *picture.sorted;
    const render::PlacedPoints placed(step.grid(), picture.explorer.scale);
    Explorer e = picture.explorer;
    e.opacityPer = render::OpacityPer::Length;
    e.order = render::Order::None;  // depth alone
    const render::Scene scene = makeScene(e, step, placed, e.play.tick);
    if (scene.layers.empty()) return kUnknown;
    const std::vector<float> depth = opticalDepthOf(scene, picture.view, wanted);
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
