// What is on the screen, being refined.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "app/drawing/refinement.h"
#include "app/drawing/screen.h"

namespace app {

// By which light falls on such a scene now.
inline std::shared_ptr<const timeseries::PointGradients> gradientsIn(const Screen& screen,
                                                                     const render::Scene& scene) {
    if (scene.light == render::Light::Off || !scene.placed.isMesh()) return nullptr;
    return screen.sorted->gradientsIfMade(scene.placed.mesh());
}

struct Resting {
    Screen of;
    Refinement refinement;

    Resting(render::FrameRenderer& renderer, render::DepthOrder& order, const Screen& screen,
            Picture picture, std::span<const render::View> eyes, bool atOnce)
        : of(screen),
          refinement(renderer, order, std::move(picture), screen.held->onGpu, eyes, atOnce) {}
    bool is(const Screen& screen, std::span<const render::View> eyes) const {
        return of.sorted == screen.sorted && of.explorer == screen.explorer &&
               std::ranges::equal(refinement.eyes(), eyes) &&
               refinement.scene().gradients == gradientsIn(screen, refinement.scene());
    }
};

}  // namespace app
