// Draws what an Exploration shows, for any number of eyes, so that frames keep their pace: steps go
// to the GPU in slices, and above a budget of splats a subset stands for all until the picture
// rests. Desktop and headset share it; a headless render needs neither slices nor subsets.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/drawing/canvas_report.h"
#include "app/drawing/drawn.h"
#include "app/exploration/exploration.h"
#include "app/picture/depth_error.h"
#include "app/picture/picture.h"
#include "render/frame/frame.h"
#include "render/model/pick.h"

namespace app {

struct Screen;

struct CanvasLimits {
    // In one frame, all layers and eyes, as render/splat/splat_cost.h counts; see
    // FramePace.
    std::uint64_t splats = 1'000'000;
    // In one frame of cells, whose cost is told less well and learnt apart; absent: as many.
    std::optional<std::uint64_t> cells = {};
    // Of a picture that moves, where what keeps to these shows nothing of the field: so many.
    struct Slower {
        std::uint64_t splats, cells;
    };
    std::optional<Slower> slower = {};
    // Of a picture that moves, instead of these: drawn so, whatever it takes.
    std::optional<Rung> rung = {};
    // Of a picture that moves, too: what is drawn keeps to these, and draws no more than this.
    std::optional<Rung> most = {};
    // Pixels may be coarser while it moves, too (app/choices/rung.h).
    bool mayBeCoarse = false;
    // What is known of the errors of what is shown: of the rungs that fit, the truest is drawn.
    // Without it the first of the ladder.
    const DepthErrors* errors = nullptr;
    std::uint64_t of(const render::Scene& scene) const {
        return scene.cells ? cells.value_or(splats) : splats;
    }
    // In one frame, of a step that comes; eight times as many of the step on the screen, so that
    // another selection of it is seen at once.
    std::uint64_t uploadBytes = std::uint64_t{16} << 20;
    // Of steps on the GPU that are not drawn, so that scrubbing back and forth is instant.
    std::uint64_t cacheBytes = std::uint64_t{1} << 30;
};

// What stands around the points.
struct CanvasScene {
    bool legend = true;
    std::span<const render::Placard> placards = {};
};

// A point of the step on the screen, in the file's own terms; where cells are drawn the one nearest
// to what is seen.
struct Probe {
    render::Picked picked;
    glm::dvec3 coordinates;            // the grid's, in its units
    std::array<std::size_t, 3> index;  // along x, y, z
    std::string cell;                  // as cellText() has it
};

// Needs a current GL context, from construction to destruction.
class Canvas {
 public:
    // `as`: what `show` takes light in memory as.
    explicit Canvas(render::SplatterChoice splatter = render::SplatterChoice::ByDevice,
                    render::LightAs as = render::LightAs::Linear);
    ~Canvas();

    using Show = std::function<void(std::size_t eye, render::Targets&)>;
    // Draws the eyes one after the other and hands each one's light (render::Targets) to `show`
    // before the next is drawn. Order is taken and uploaded once. What is not on the GPU yet is not
    // drawn: the step or the choices before stay, and the report says so. Nothing is drawn, and
    // `show` is not called, before the first step is there. `moving`: the picture is expected to
    // change again at once, so the limits hold; else all points are drawn. Waits for the GPU only
    // where a new selection's cells are listed by it, to know how many there are.
    // REQUIRES: at least one eye.
    CanvasReport draw(const Shown& shown, std::span<const render::View> eyes,
                      const CanvasLimits& limits, bool moving, const Show& show,
                      const CanvasScene& scene = {});
    // Of what draw() has just drawn of these eyes, and said.
    SubsetCosts subsetCosts(const CanvasReport& of, std::span<const render::View> eyes) const;
    // The picture that draw() makes of all points, for a window at rest: each call draws no more
    // than the limits and a little, and `show` gets an eye when the last of its points is drawn;
    // what was shown before holds until then. Begins anew when something else is asked for, by this
    // or another function.
    CanvasReport refine(const Shown& shown, std::span<const render::View> eyes,
                        const CanvasLimits& limits, const Show& show);
    // Whether what refine() has drawn lacks only the light of points' gradients, which are being
    // made: it would draw the same again.
    bool waitsForGradients();
    // Draws placards alone: where draw() has nothing to draw.
    void drawPlacards(std::span<const render::Placard> placards, std::span<const render::View> eyes,
                      const Show& show);

    // The eyes of the shown explorer on a picture of its size (camera.h).
    std::vector<render::View> eyesOf(const Shown& shown) const;
    // Whether what is on the screen is of these data, which may have come since it was drawn.
    bool shows(const Explorer& data) const;
    // What is on the screen, until the next draw(); none before the first.
    std::optional<Drawn> drawn() const;
    const Screen* screen() const;  // likewise, with the choices that it shows
    // What an eye sees at a window position (pixels, y up), of what was drawn last; see pick.h.
    std::optional<Probe> probe(const render::View& eye, const glm::dvec2& window) const;
    // The picture as files have it: drawn whole and read back, with the session embedded. The step
    // shown, also when it is not on the screen yet. `error`: of this picture, where it is known.
    // Throws ImageError.
    void save(const Shown& shown, const std::filesystem::path& file,
              const std::optional<double>& error = {});

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace app
