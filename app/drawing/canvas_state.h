// What a canvas has on the screen, and what every frame of it begins with.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "app/drawing/canvas.h"
#include "app/drawing/cell_maker.h"
#include "app/drawing/gl_steps.h"
#include "app/drawing/moving_rung.h"
#include "app/drawing/resting.h"
#include "app/drawing/screen.h"
#include "app/drawing/telling.h"
#include "render/frame/frame_pace.h"
#include "render/gl/timer.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/gl_tets.h"

namespace app {

inline GlSteps::Places placesOf(const Explorer& e) { return {e.scale, e.map}; }

struct Canvas::State {
    State(render::SplatterChoice splatter, render::LightAs as) : renderer(splatter, as) {}

    render::FrameRenderer renderer;
    render::gl::Timer timer, refineTimer;
    GlSteps steps;
    CellMaker cells;
    std::optional<Screen> screen;
    Rung rung{Model::Points};         // of what was shown last,
    bool gaveWay = false;             // and whether beyond the pace
    render::DepthOrder order;         // of pictures at rest
    std::optional<Resting> resting;   // uses the renderer alone
    bool lacksOnlyGradients = false;  // what was refined last
    Telling telling;

    // What every frame begins with: brings what is shown and tells of it. `moving`: the eyes for
    // which the limits hold.
    CanvasReport begin(const Shown& shown, const CanvasLimits& limits,
                       std::span<const render::View> moving, render::gl::Timer& of);
    // What planes cost anyhow is taken from the limit, but of few splats nothing. `share`: of the
    // limit.
    bool keepsTo(const CanvasLimits& limits, const render::Scene& scene,
                 std::span<const render::View> eyes, double share = 1) const {
        const std::uint64_t limit = limits.of(scene), planes = planesCost(scene, eyes);
        const std::uint64_t least = std::min(limit, render::FramePace::kFewest);
        return costOf(scene, eyes) <=
               share * static_cast<double>(std::max(limit - std::min(limit, planes), least));
    }
    double costOf(const render::Scene& scene, std::span<const render::View> eyes) const {
        double sum = 0;
        for (const render::View& eye : eyes) sum += renderer.splatsCost(scene, eye);
        return sum;
    }
    std::uint64_t planesCost(const render::Scene& scene, std::span<const render::View> eyes) const {
        double sum = 0;
        for (const render::View& eye : eyes) sum += renderer.planesCost(scene, eye);
        return static_cast<std::uint64_t>(std::llround(sum));
    }
    // For a picture that moves: the rung that it is drawn on (app/choices/rung.h), and what is
    // drawn there.
    struct Moving {
        Rung rung;
        render::Scene scene;
        bool gaveWay = false;  // beyond the pace
    };
    Moving moving(const render::Scene& whole, std::span<const render::View> eyes,
                  const CanvasLimits& limits) const;
    // Uploads a slice of what is shown and, once all that it selects is there, puts it on the
    // screen. Returns the step shown.
    GlSteps::Held& bring(const Shown& shown, const CanvasLimits& limits,
                         std::span<const render::View> moving, CanvasReport& report);
    // Of what the next frame has on the screen.
    render::Outline outline(const Shown& shown);
    // The step on the screen takes other choices, if all that they select is there to be drawn.
    void choose(const Explorer& choices);
    bool isThere(const GlSteps::Held& held, const render::Scene& scene) const {
        return !renderer.splatters().takesPointsFromGpu(scene) || held.onGpu.ready(scene);
    }
    // Whether what is shown is to lie otherwise than what is on the screen, of which the eyes are
    // until all that the other may be drawn by is there.
    bool turns(const GlSteps::Places& asked) const {
        return screen && screen->held->places.map != asked.map;
    }
    bool isWhollyThere(const GlSteps::Held& held, const render::Scene& scene) const {
        return isThere(held, scene) && isThere(held, byPoints(scene));
    }
    // Tetrahedra for GL are listed by the processor in one go when the selection changes: so many
    // in 50 ms on two cores (tests/bench/NOTES.md).
    bool listsForLong(const render::Scene& scene) const {
        constexpr std::uint64_t kMost = sizeof(render::GlTet) << 17;
        const render::Splatters& splatters = renderer.splatters();
        return scene.cells && scene.placed.isMesh() && splatters.sumsByGl(scene) &&
               !splatters.holdsCells(scene) && render::GlPieces::bytesOf(scene) > kMost;
    }
    // Whether cells of a mesh come by their middles. Few are put in order in 5 ms; GL's by the
    // processor, in one go and for each eye, which its frames have no time for.
    bool isByMiddles(const render::Scene& scene, bool moving) const {
        constexpr std::uint64_t kFew = 1 << 14, kMostOfGl = 1 << 16;
        const std::uint64_t count = render::cellCount(scene, render::Channels::Over, 0);
        const bool byGl = renderer.splatters().sumsByGl(scene);
        return moving ? byGl || count > kFew : byGl && count > kMostOfGl;
    }
    // While GL holds a mesh's tetrahedra as they were before there were gradients, and to list them
    // anew takes long: so.
    render::Scene asHeld(const render::Scene& scene) const {
        render::Scene before = scene;
        before.gradients = nullptr;
        return listsForLong(scene) && renderer.splatters().holdsCells(before) ? before : scene;
    }
    // What stands there in what was shown last.
    std::optional<render::Picked> pick(const render::View& eye, const glm::dvec2& window) const;
    // What of the scene is on the screen.
    void tell(CanvasReport& report, const render::Scene& scene) const;
    // Whether what is to be drawn by cells is drawn by points.
    bool lacksCells(const render::Scene& drawn) const {
        return !drawn.cells && needsCells(screen->explorer, *screen->sorted);
    }
};

}  // namespace app
