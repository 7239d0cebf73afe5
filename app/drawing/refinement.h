// A picture at rest, drawn over as many frames as its points take. Whoever has begun one draws
// nothing else with the same renderer until it is done, or drops it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/picture/picture.h"
#include "render/frame/frame.h"

namespace app {

class Refinement {
 public:
    // The renderer, `order`, which has no other user meanwhile, `onGpu`, ready for the picture, and
    // what the picture refers to must outlive this. `atOnce`: one goOn() is expected to draw it.
    // REQUIRES: at least one eye, all of one size.
    Refinement(render::FrameRenderer& renderer, render::DepthOrder& order, Picture picture,
               const render::GlStep& onGpu, std::span<const render::View> eyes, bool atOnce);
    ~Refinement() { order_.shrink(); }
    Refinement(const Refinement&) = delete;
    Refinement& operator=(const Refinement&) = delete;

    // Goes on with what the program makes before it draws, a draw list or cells for GL, for about
    // as long as a frame takes. True when it is there.
    bool order();
    // Draws until `cost` is reached (render/splat/splat_cost.h), a little more than that, and of
    // cells no longer than two frames take; hands each eye's light to `show` once it is whole.
    // Returns what it cost. REQUIRES: order(), and not done.
    double goOn(double cost, const std::function<void(std::size_t eye, render::Targets&)>& show);
    bool done() const { return eye_ == eyes_.size(); }
    double share() const;  // of all that is to be done, [0, 1]
    const render::Scene& scene() const { return picture_.scene; }
    std::span<const render::View> eyes() const { return eyes_; }

 private:
    void orderPoints();  // a slice of it
    void makeCells();    // a slice of them

    render::FrameRenderer& renderer_;
    const Picture picture_;
    const std::vector<render::View> eyes_;
    const render::FrameContent content_;
    const render::GlStep& onGpu_;
    render::DepthOrder& order_;
    bool sortsHere_;  // the program does, before anything is drawn
    // The share of all that is to be done of what is made before, and of that what is made.
    double making_ = 0, made_ = 0;
    std::optional<const render::FrameRenderer::Prepared> frame_;  // once it is ordered
    double cost_ = 0, drawn_ = 0;  // of all eyes, and of what is drawn
    std::size_t eye_ = 0;          // to go on with
    std::optional<render::FrameRenderer::EyeInWork> work_;
};

}  // namespace app
