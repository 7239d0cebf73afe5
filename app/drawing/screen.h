// What stands on the screen.
#pragma once

#include <cstddef>
#include <memory>

#include "app/drawing/gl_steps.h"
#include "app/files/dataset.h"
#include "app/picture/picture.h"

namespace app {

// A step, and choices of which all that they select is there to be drawn.
struct Screen {
    std::shared_ptr<const timeseries::SortedStep> sorted;
    GlSteps::Held* held;
    Explorer explorer;
    timeseries::Variable variable;
    std::size_t step;
};

// By points while its cells are made.
inline render::Scene sceneOf(const Screen& screen) {
    return makeScene(screen.explorer, *screen.sorted, screen.held->placed,
                     screen.explorer.play.tick, Await::Nothing);
}

}  // namespace app
