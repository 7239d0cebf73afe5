// What a picture that moves draws of a scene on each rung of the ladder (app/choices/rung.h), and
// which it takes. Pure.
#pragma once

#include <functional>
#include <span>

#include "app/picture/depth_error.h"
#include "render/model/scene.h"

namespace app {

// The same selection, of which points stand for cells.
render::Scene byPoints(render::Scene scene);
// All of it.
inline Rung rungOf(const render::Scene& whole) {
    return {whole.cells ? Model::Cells : Model::Points};
}
// What is drawn on a rung of a scene that has all of it.
render::Scene sceneOn(const Rung& rung, const render::Scene& whole);

// Whether it tells of what is left out more than of the field: it is known to be so far off or,
// where errors are not known, has some of the points in place of cells.
bool showsNothing(const Rung& rung, bool ofCells, const DepthErrors* errors);

// Climbing wants room to spare: of a limit that swings about what a rung takes, the picture would
// change all the time.
constexpr double kToClimb = 0.8;

// Of those that fit the truest, by what is known of errors; without errors the first. Where none
// fits the last. `fits(rung, share)`: whether it keeps to this share of the limits; `last`: what
// was drawn before.
Rung truestThatFits(std::span<const Rung> rungs, const Rung& last, const DepthErrors* errors,
                    const std::function<bool(const Rung&, double)>& fits);

}  // namespace app
