#include "app/refinement.h"

#include <algorithm>

#include "app/still.h"

namespace app {

Refinement::Refinement(render::FrameRenderer& renderer, Picture picture,
                       const render::GpuStep& onGpu, std::span<const render::View> eyes)
    : renderer_(renderer),
      picture_(std::move(picture)),
      eyes_(eyes.begin(), eyes.end()),
      content_{picture_.scene, picture_.scene.step.grid(), picture_.legend, kBackground},
      frame_(renderer.prepare(content_, onGpu, eyes_)) {
    for (const render::View& eye : eyes_) cost_ += renderer.cost(frame_, eye);
}

double Refinement::goOn(double cost,
                        const std::function<void(std::size_t eye, render::Targets&)>& show) {
    const double before = drawn_;
    do {
        if (!work_) work_.emplace(renderer_.begin(frame_, eyes_[eye_]));
        const double of = work_->cost;
        const bool whole = renderer_.goOn(*work_, cost - (drawn_ - before));
        drawn_ += work_->cost - of;
        if (!whole) break;
        show(eye_++, renderer_.targets());
        work_.reset();
    } while (!done() && drawn_ - before < cost);
    return drawn_ - before;
}

double Refinement::share() const { return cost_ > 0 ? std::min(drawn_ / cost_, 1.0) : 1; }

}  // namespace app
