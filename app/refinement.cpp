#include "app/refinement.h"

#include "app/still.h"

namespace app {

Refinement::Refinement(render::FrameRenderer& renderer, Picture picture,
                       const render::GpuStep& onGpu, std::span<const render::View> eyes)
    : renderer_(renderer),
      picture_(std::move(picture)),
      eyes_(eyes.begin(), eyes.end()),
      content_{picture_.scene, picture_.scene.step.grid(), picture_.legend, kBackground},
      frame_(renderer.prepare(content_, onGpu, eyes_)),
      cost_(eyes_.size() * renderer.cost(frame_)) {}

std::uint64_t Refinement::goOn(
    std::uint64_t splats,
    const std::function<void(std::size_t eye, const render::Targets&)>& show) {
    const std::uint64_t before = drawn_;
    do {
        if (!work_) work_.emplace(renderer_.begin(frame_, eyes_[eye_]));
        const std::uint64_t of = work_->cost;
        const bool whole = renderer_.goOn(*work_, splats - (drawn_ - before));
        drawn_ += work_->cost - of;
        if (!whole) break;
        show(eye_++, renderer_.targets());
        work_.reset();
    } while (!done() && drawn_ - before < splats);
    return drawn_ - before;
}

double Refinement::share() const {
    return cost_ == 0 ? 1 : static_cast<double>(drawn_) / static_cast<double>(cost_);
}

}  // namespace app
