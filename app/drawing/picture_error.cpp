#include "app/drawing/picture_error.h"

#include <atomic>
#include <limits>
#include <new>
#include <thread>

#include "app/picture/picture.h"
#include "render/frame/plain_frame.h"
#include "render/reference/sampled_error.h"

namespace app {

// Written by its thread until `done`.
struct PictureError::Work {
    Picture picture;
    double error = std::numeric_limits<double>::quiet_NaN();
    std::atomic<bool> done = false;
};

double PictureError::worked(const Picture& picture) {
    const timeseries::SortedStep& step = *picture.sorted;
    const render::PlacedPoints placed(step.grid(), picture.explorer.scale);
    Explorer e = picture.explorer;
    e.opacityPer = render::OpacityPer::Length;
    e.order = render::Order::None;  // depth alone
    const render::Scene scene = makeScene(e, step, placed, e.play.tick);
    const std::vector<float> depth =
        render::PlainFrame(picture.view.size, glm::dvec3(0)).opticalDepth(scene, picture.view);
    const auto cells = step.cellsIfMade();
    const timeseries::Field field = cells ? timeseries::Field{} : fieldOf(step);
    return sampledError(scene, cells ? cells->field() : field, picture.view, depth).relativeL2;
}

std::optional<double> PictureError::of(const Picture& picture) {
    if (work_ && !work_->done) return std::nullopt;
    if (work_ && work_->picture == picture) return work_->error;
    work_ = std::make_shared<Work>();
    work_->picture = picture;
    std::thread([work = work_] {
        try {
            work->error = worked(work->picture);
        } catch (const std::bad_alloc&) {  // then it is not told
        }
        work->done = true;
    }).detach();
    return std::nullopt;
}

}  // namespace app
