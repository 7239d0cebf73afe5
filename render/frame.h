// One frame for any number of eyes: opaque scene, splats, resolve, legend. The draw list is ordered
// and uploaded once and drawn once an eye, whichever front end asks.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/axes.h"
#include "render/covered.h"
#include "render/flat_pass.h"
#include "render/gl/driver.h"
#include "render/gl_list.h"
#include "render/hidden_area_pass.h"
#include "render/image.h"
#include "render/legend.h"
#include "render/placard.h"
#include "render/processor_splatter.h"
#include "render/targets.h"

namespace render {

struct FrameContent {
    const Scene& scene;
    const timeseries::Grid& grid;  // the scene's, for axes
    Legend legend;
    glm::dvec3 background{0};  // linear
    // Opaque, like the axes; they hide labels.
    std::span<const Placard> placards = {};
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

// Needs a current GL context, from construction to destruction.
class FrameRenderer {
 public:
    explicit FrameRenderer(SplatterChoice splatter = SplatterChoice::ByDevice);

    // Draws each eye and reads it back, with all that the scene needs of its step on the GPU: the
    // picture does not depend on what was drawn before. Order is taken from the point midway
    // between the eyes. REQUIRES: at least one eye. Throws std::runtime_error on a GL error.
    std::vector<EyePicture> render(const FrameContent& content, GpuStep& step,
                                   std::span<const View> eyes, const Extras& extras = {});

    // Whether drawing the scene takes its points from the GPU; else the program sums them itself.
    bool takesPointsFromGpu(const Scene& scene) const;
    // The same in its parts, for front ends that show the light instead of reading it. REQUIRES: a
    // step that is ready for the scene, if its points are taken from it.
    struct Prepared {
        const FrameContent& content;
        std::unique_ptr<SplatFrame> splats;
        glm::dvec3 midEye;
    };
    Prepared prepare(const FrameContent& content, const GpuStep& step, std::span<const View> eyes);
    // One of the eyes that the frame was prepared for; its light is then in targets().
    void drawEye(const Prepared& frame, const View& eye);
    // The same bit for bit over several frames, in which nothing else is drawn. Frame and view must
    // outlive it.
    struct EyeInWork {
        const Prepared& frame;
        const View& eye;
        FlatMesh legend;
        AxesMeshes axes;
        std::vector<double> splatCosts;  // of each plane; render/splat_cost.h
        std::size_t plane = 0;           // to go on with
        std::unique_ptr<PlaneSum> sum = {};
        double cost = 0;  // of what is drawn so far, in ordinary splats
    };
    EyeInWork begin(const Prepared& frame, const View& eye);
    // Draws until this cost is reached, or a little more: what a splatter adds at least.
    // True when the light is in targets(); before, there is nothing to see.
    bool goOn(EyeInWork& work, double cost);
    double cost(const Prepared& frame, const View& eye) const;  // of the whole eye
    // An eye that sees nothing but placards. REQUIRES: makeRoom() for it.
    void drawPlacards(std::span<const Placard> placards, const glm::dvec3& background,
                      const View& eye);
    // Keeps targets of these eyes' sizes, and no others; prepare() does that.
    void makeRoom(std::span<const View> eyes);
    const Targets& targets() const { return *targets_[current_]; }  // of the eye drawn last

    struct Counts {
        std::uint64_t orders = 0, eyes = 0;
    };
    Counts counts() const { return {orders_, eyes_}; }

 private:
    Targets& use(glm::ivec2 size);  // which targets() then are
    // What hides splats.
    struct Occluders {
        const FlatMesh& behind;
        std::span<const Placard> placards;
    };
    // Leaves the depth attachment, which all planes and the light share, holding these alone.
    void drawDepth(const Occluders& occluders, const View& view, GLuint framebuffer);
    // For channels of data: no line of the box hides what they hold.
    void drawNoOccluders(const View& view);
    bool drawSplats(EyeInWork& work, double cost);
    std::vector<double> splatCosts(const Scene& scene, const View& eye) const;
    void drawWhole(const Prepared& frame, const View& eye,
                   const std::function<void(double)>& progress);
    Splatter& splatterFor(const Scene& scene);
    void drawLight(const EyeInWork& work);
    void resolve(const Scene& scene, const PixelBox& covered);
    const gl::Program& resolveProgram(const Scene& scene);
    // Of an unordered scene.
    std::vector<float> opticalDepth(const Scene& scene, SplatFrame& splats, const View& view);

    std::array<FontStyle, 2> styles_;  // that font_ holds
    Font font_;
    std::unique_ptr<FlatPass> flat_;
    GlSplatter gl_;
    ProcessorSplatter processor_;
    std::map<int, gl::Program> resolve_;  // by the number of layers; -1 for an ordered scene
    PlacardPass placards_;
    HiddenAreaPass hidden_;
    gl::VertexArray noVertices_;
    std::vector<std::unique_ptr<Targets>> targets_;  // all of different sizes
    std::size_t current_ = 0;
    bool sums_;  // planes itself, where it can
    std::uint64_t orders_ = 0, eyes_ = 0;
};

}  // namespace render
