#include "app/drawing/refinement.h"

#include <algorithm>
#include <chrono>

#include "app/picture/still.h"

namespace app {
namespace {

using namespace std::chrono_literals;

// Of what is to be done: the list's share, where there is one.
constexpr double kOrdering = 0.2;

}  // namespace

Refinement::Refinement(render::FrameRenderer& renderer, Picture picture,
                       const render::GlStep& onGpu, std::span<const render::View> eyes)
    : renderer_(renderer),
      picture_(std::move(picture)),
      eyes_(eyes.begin(), eyes.end()),
      content_{picture_.scene, picture_.scene.step.grid(), picture_.legend, kBackground},
      onGpu_(onGpu) {
    if (!picture_.scene.cells) order_.begin(picture_.scene, render::midEye(eyes_));
}

bool Refinement::order() {
    if (frame_) return true;
    const bool byCells = picture_.scene.cells != nullptr;  // which come in an order of their own
    if (!byCells && !orderPoints()) return false;
    frame_.emplace(
        renderer_.prepare(content_, onGpu_, eyes_, byCells ? render::DrawList() : order_.take()));
    for (const render::View& eye : eyes_) cost_ += renderer_.cost(*frame_, eye);
    return true;
}

bool Refinement::orderPoints() {
    constexpr std::uint64_t kAtOnce = 1 << 17;
    const auto until = std::chrono::steady_clock::now() + 4ms;
    while (!order_.done()) {
        order_.goOn(kAtOnce);
        if (std::chrono::steady_clock::now() >= until) break;
    }
    return order_.done();
}

double Refinement::goOn(double cost,
                        const std::function<void(std::size_t eye, render::Targets&)>& show) {
    const double before = drawn_;
    do {
        if (!work_) work_.emplace(renderer_.begin(*frame_, eyes_[eye_]));
        const double of = work_->cost;
        const bool whole = renderer_.goOn(*work_, cost - (drawn_ - before));
        drawn_ += work_->cost - of;
        if (!whole) break;
        show(eye_++, renderer_.targets());
        work_.reset();
    } while (!done() && drawn_ - before < cost);
    return drawn_ - before;
}

double Refinement::share() const {
    const bool isListed = !picture_.scene.cells && picture_.scene.order != render::Order::None;
    const double ordering = isListed ? kOrdering : 0;
    if (!frame_) return isListed ? ordering * order_.share() : 0;
    const double drawn = cost_ > 0 ? std::min(drawn_ / cost_, 1.0) : 1;
    return ordering + (1 - ordering) * drawn;
}

}  // namespace app
