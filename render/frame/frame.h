// One frame for any number of eyes: opaque scene, splats, resolve, legend. The draw list is ordered
// and uploaded once and drawn once an eye, whichever front end asks.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/annotate/box_edges.h"
#include "render/frame/gl_light.h"
#include "render/frame/memory_light.h"
#include "render/frame/splatters.h"
#include "render/splat/splat_cost.h"

namespace render {

struct FrameContent {
    const Scene& scene;
    const timeseries::Grid& grid;  // the scene's, for axes
    Legend legend;
    glm::dvec3 background{0};  // linear
    // Planes are summed in pixels that have so many of the picture's across; lines and text are
    // not.
    int across = 1;
    // Opaque, like the axes; they hide labels.
    std::span<const Placard> placards = {};
    bool axes = true;  // drawn about the points
};

// What an eye's picture may bring besides light, row 0 at the top. Empty when not asked for. These
// hold data alone: what the picture shows beside it, lines and placards, hides nothing of them.
struct EyePicture {
    Image image;
    std::vector<float> opticalDepth;  // of all layers together
    std::vector<float> splatCount;    // splats that touch the pixel
};
struct Extras {
    bool opticalDepth = false, splatCount = false;
    // Told now and then which share of a picture's splats is drawn, [0, 1].
    std::function<void(double)> progress = {};
};

// Where all eyes' draw list is made for.
glm::dvec3 midEye(std::span<const View> eyes);
// What their labels are chosen for.
Middle middleOf(std::span<const View> eyes);

// Needs a current GL context, from construction to destruction, unless its splatter needs none
// (render/frame/splatters.h) and what it draws has neither placards nor hidden areas.
class FrameRenderer {
 public:
    // `as`: what front ends want of light that the program makes in memory.
    explicit FrameRenderer(SplatterChoice splatter = SplatterChoice::ByDevice,
                           LightAs as = LightAs::Linear);

    // Draws each eye and reads it back, with all that the scene needs of its step on the GPU: the
    // picture does not depend on what was drawn before. Order is taken from the point midway
    // between the eyes. REQUIRES: at least one eye. Throws std::runtime_error on a GL error.
    std::vector<EyePicture> render(const FrameContent& content, GlStep& step,
                                   std::span<const View> eyes, const Extras& extras = {});

    const Splatters& splatters() const { return splatters_; }
    Splatters& splatters() { return splatters_; }
    // render() in its parts, for front ends that show the light instead of reading it. REQUIRES: a
    // step that is ready for the scene, if its points are taken from it.
    struct Prepared {
        const FrameContent& content;
        std::unique_ptr<SplatFrame> splats;
        Middle middle;
        LightPass& light;
        LightAs as;
    };
    Prepared prepare(const FrameContent& content, const GlStep& step, std::span<const View> eyes);
    // With a list that somebody else has made for midEye(eyes), if it is not Exact's.
    Prepared prepare(const FrameContent& content, const GlStep& step, std::span<const View> eyes,
                     DrawList list);
    // One of the eyes that the frame was prepared for; its light is then in targets().
    // Returns its cost.
    double drawEye(const Prepared& frame, const View& eye);
    // An eye drawn over several frames, bit for bit as drawEye() draws it, in which nothing else is
    // drawn. Frame and view must outlive it.
    struct EyeInWork {
        const Prepared& frame;
        const View& eye;
        View planes;  // what they are summed in: the eye, or a coarser one
        FlatMesh legend;
        AxesMeshes axes;
        // Of each plane one of what its sum counts; render/splat/splat_cost.h.
        std::vector<double> splatCosts;
        std::size_t plane = 0;  // to go on with
        std::unique_ptr<PlaneSum> sum = {};
        double cost = 0;   // of what is drawn so far (render/splat/splat_cost.h)
        double slice = 0;  // that is drawn between two looks at the clock; 0: not known yet
    };
    EyeInWork begin(const Prepared& frame, const View& eye);
    using Clock = std::chrono::steady_clock;
    // Draws until this cost is reached, or a little more: what a splatter adds at least. Costs are
    // of a mean, and what is drawn first, beside the eye, may take many times as long: it ends at
    // that time, too. True when the light is in targets(); before, there is nothing to see.
    bool goOn(EyeInWork& work, double cost, Clock::time_point end = Clock::time_point::max());
    double cost(const Prepared& frame, const View& eye) const;  // of the whole eye
    // What the scene's splats cost, by who sums them.
    double splatsCost(const Scene& scene, const View& eye) const;
    // Beside them, what remains of however few splats.
    double planesCost(const Scene& scene, const View& eye) const;
    // Eyes that see nothing but placards, each shown once it is drawn.
    void drawPlacards(std::span<const Placard> placards, const glm::dvec3& background,
                      std::span<const View> eyes,
                      const std::function<void(std::size_t eye, Targets&)>& show);
    Targets& targets() { return *targets_[current_].targets; }  // of the eye drawn last

    struct Counts {
        std::uint64_t orders = 0, eyes = 0;
    };
    Counts counts() const { return {orders_, eyes_}; }

 private:
    // Keeps targets of these eyes' sizes, and no others.
    void makeRoom(std::span<const View> eyes, const LightPass& light);
    Targets& use(glm::ivec2 size, const LightPass& light);  // which targets() then are
    Prepared prepare(const FrameContent& content, const GlStep& step, std::span<const View> eyes,
                     DrawList list, LightAs as);
    GlLight& glLight();  // made when it is first needed
    LightPass& lightFor(const FrameContent& content, std::span<const View> eyes);
    std::vector<double> splatCosts(const Prepared& frame, const View& eye) const;
    SummedBy summedBy(const Scene& scene) const {
        return splatters_.sumsByGl(scene) ? SummedBy::Gl : SummedBy::Program;
    }
    bool drawSplats(EyeInWork& work, double cost, Clock::time_point end);
    void drawWhole(const Prepared& frame, const View& eye,
                   const std::function<void(double)>& progress);
    // Data alone: what the picture shows beside it hides nothing.
    void addData(const FrameContent& content, GlStep& step, std::span<const View> eyes,
                 LightPass& light, const Extras& extras, std::vector<EyePicture>& pictures);
    // Row 0 at the top.
    std::vector<float> dataPlane(SplatFrame& splats, const View& view, Channels channels,
                                 std::size_t layer, LightPass& light);

    std::array<FontStyle, 2> styles_{};  // that font_ holds
    std::optional<Font> font_;           // made for the first picture, which tells its size
    Splatters splatters_;
    MemoryLight inMemory_;
    std::unique_ptr<GlLight> onGl_;
    struct Held {
        const LightPass* of;
        std::unique_ptr<Targets> targets;
    };
    std::vector<Held> targets_;  // all of different sizes
    std::size_t current_ = 0;
    LightAs as_;
    std::uint64_t orders_ = 0, eyes_ = 0;
};

}  // namespace render
