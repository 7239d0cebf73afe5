#include "app/drawing/refinement.h"

#include <algorithm>
#include <chrono>

#include "app/picture/still.h"

namespace app {
namespace {

using namespace std::chrono_literals;

// Of what is to be done: a list's share, where there is one, and that of cells for GL.
constexpr double kOrdering = 0.2, kMaking = 0.5;
// Between two frames of the window, each of which takes about as long.
constexpr auto kSlice = 16ms;
// Of cells, which do not cost alike, though they be cheaper in the mean.
constexpr auto kLongestSlice = 2 * kSlice;

}  // namespace

Refinement::Refinement(render::FrameRenderer& renderer, render::DepthOrder& order, Picture picture,
                       const render::GlStep& onGpu, std::span<const render::View> eyes, bool atOnce)
    : renderer_(renderer),
      picture_(std::move(picture)),
      eyes_(eyes.begin(), eyes.end()),
      content_{picture_.scene, picture_.scene.step.grid(), picture_.legend, kBackground},
      onGpu_(onGpu),
      order_(order),
      sortsHere_(!(atOnce && render::ProcessorSplatter::sortsWhenDrawn(picture_.scene)) &&
                 !renderer.splatters().sortsOnGpu(picture_.scene, onGpu)) {
    const render::Scene& scene = picture_.scene;
    if (!sortsHere_) return;
    order_.begin(scene, render::midEye(eyes_));
    if (!order_.done()) making_ = kOrdering;
    if (scene.cells && renderer.splatters().sumsByGl(scene) &&
        !renderer.splatters().holdsCells(scene))
        making_ = kMaking;
}

bool Refinement::order() {
    if (frame_) return true;
    if (making_ == kMaking)
        makeCells();
    else if (sortsHere_)
        orderPoints();
    if (making_ > 0 && made_ < 1) return false;
    if (sortsHere_)
        frame_.emplace(renderer_.prepare(content_, onGpu_, eyes_, order_.take()));
    else
        frame_.emplace(renderer_.prepare(content_, onGpu_, eyes_));
    for (const render::View& eye : eyes_) cost_ += renderer_.cost(*frame_, eye);
    return true;
}

void Refinement::orderPoints() {
    constexpr std::uint64_t kAtOnce = 1 << 17;
    const auto until = std::chrono::steady_clock::now() + kSlice;
    while (!order_.done()) {
        order_.goOn(kAtOnce);
        if (std::chrono::steady_clock::now() >= until) break;
    }
    made_ = order_.done() ? 1 : order_.share();
}

void Refinement::makeCells() {
    constexpr std::uint64_t kAtOnce = 1 << 12;
    const auto until = std::chrono::steady_clock::now() + kSlice;
    do made_ = renderer_.splatters().makeCells(picture_.scene, kAtOnce);
    while (made_ < 1 && std::chrono::steady_clock::now() < until);
}

double Refinement::goOn(double cost,
                        const std::function<void(std::size_t eye, render::Targets&)>& show) {
    const double before = drawn_;
    using Clock = render::FrameRenderer::Clock;
    const Clock::time_point end =
        picture_.scene.cells ? Clock::now() + kLongestSlice : Clock::time_point::max();
    do {
        const double of = work_ ? work_->cost : 0;
        if (!work_) work_.emplace(renderer_.begin(*frame_, eyes_[eye_]));
        const bool whole = renderer_.goOn(*work_, cost - (drawn_ - before), end);
        drawn_ += work_->cost - of;
        if (!whole) break;
        show(eye_++, renderer_.targets());
        work_.reset();
    } while (!done() && drawn_ - before < cost && Clock::now() < end);
    return drawn_ - before;
}

double Refinement::share() const {
    if (!frame_) return making_ * made_;
    const double drawn = !done() && cost_ > 0 ? std::min(drawn_ / cost_, 1.0) : 1;
    return making_ + (1 - making_) * drawn;
}

}  // namespace app
