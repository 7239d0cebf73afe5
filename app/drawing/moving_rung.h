// What a picture that moves draws of a scene on each rung of the ladder (app/choices/rung.h), and
// which it takes. Pure.
#pragma once

#include <functional>
#include <span>

#include "app/drawing/canvas.h"
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

// Of those that fit the truest, by what is known of errors; without errors the first. Where none
// fits the last. `fits(rung, share)`: whether it keeps to this share of the limits; `last`: what
// was drawn before.
Rung truestThatFits(std::span<const Rung> rungs, const Rung& last, const DepthErrors* errors,
                    const std::function<bool(const Rung&, double)>& fits);

// What was drawn before, or is to be, and whether beyond the pace.
struct PacedRung {
    Rung rung;
    bool gaveWay = false;
};
// The rung that the limits fix. Else the truest that keeps to them; where that shows nothing, the
// truest that keeps to the slower ones, if there are such. `fits` is as above, of these budgets.
PacedRung rungInTime(std::span<const Rung> rungs, const PacedRung& last, bool ofCells,
                     const CanvasLimits& limits,
                     const std::function<bool(const CanvasLimits&, const Rung&, double)>& fits);

}  // namespace app
