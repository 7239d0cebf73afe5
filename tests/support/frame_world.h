// Noise in two layers, one of a colour and one of many, and two eyes that look at it.
#pragma once

#include <string>

#include "render/frame/frame.h"
#include "render/gl/headless_context.h"
#include "tests/support/scenes.h"

namespace tests {

struct FrameWorld {
    render::FrameContent content() {
        return {scene_, step_.grid(), {}, glm::dvec3(0.02, 0.03, 0.04)};
    }
    render::gl::HeadlessContext context_;
    timeseries::SortedStep step_ = noise(cube(20));
    render::PlacedPoints placed_{step_.grid()};
    render::GlStep onGpu_{step_, placed_};
    render::Scene scene_{.step = step_,
                         .placed = placed_,
                         .layers = {{step_.select(timeseries::RangeSet::parse("0.1:0.2")),
                                     {render::Constant{{1, 0.2, 0}}, 0.2}},
                                    {step_.select(timeseries::RangeSet::parse("0.7:0.9")),
                                     {render::ByValue{{}, 0.7, 0.9}, 0.3}}},
                         .footprint = {},
                         .order = render::Order::None,
                         .clip = {}};
    render::View left_ = lookFrom({-0.05, -3, 0}, {200, 160});
    render::View right_ = lookFrom({0.05, -3, 0}, {200, 160});
};

inline std::string nameOf(render::SplatterChoice choice) {
    return choice == render::SplatterChoice::Gl    ? "Gl"
           : choice == render::SplatterChoice::Cpu ? "Cpu"
                                                   : "Exact";
}

}  // namespace tests
