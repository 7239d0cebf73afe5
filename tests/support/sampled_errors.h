// How far a picture is from the truth, told from some of its pixels.
#pragma once

#include "render/reference/sampled_error.h"
#include "tests/support/cell_worlds.h"

namespace tests {

struct SampledError {
    double relativeL2;   // of optical depth
    std::size_t pixels;  // looked at
};
inline SampledError sampledError(const CellWorld& world, const render::View& view,
                                 const render::DepthAt& picture, const render::Sampling& sampling) {
    render::SampledTruth truth(world.scene, view, picture, sampling);
    for (const auto rays : {render::SampledTruth::Rays::Quarter, render::SampledTruth::Rays::Rest})
        truth.add(world.scene.cells->field(), rays);
    return {truth.apart(picture(truth.pixels()), truth.depth()), truth.pixels().size()};
}

}  // namespace tests
