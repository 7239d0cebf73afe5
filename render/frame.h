// One frame for any number of eyes: opaque scene, splats, resolve, legend. The draw list is ordered
// and uploaded once and drawn once an eye, whichever front end asks.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "render/axes.h"
#include "render/covered.h"
#include "render/flat_pass.h"
#include "render/gl/driver.h"
#include "render/gl_list.h"
#include "render/image.h"
#include "render/legend.h"
#include "render/placard.h"
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

// What an eye's picture may bring besides light, row 0 at the top. Empty when not asked for.
struct EyePicture {
    Image image;
    std::vector<float> opticalDepth;  // of all layers together
    std::vector<float> splatCount;    // splats that touch the pixel
};
struct Extras {
    bool opticalDepth = false, splatCount = false;
};

// Needs a current GL context, from construction to destruction.
class FrameRenderer {
 public:
    FrameRenderer();

    // Draws each eye and reads it back, with all that the scene needs of its step on the GPU: the
    // picture does not depend on what was drawn before. Order is taken from the point midway
    // between the eyes. REQUIRES: at least one eye, all of one size. Throws
    // std::runtime_error on a GL error.
    std::vector<EyePicture> render(const FrameContent& content, GpuStep& step,
                                   std::span<const View> eyes, const Extras& extras = {});

    // The same in its parts, for front ends that show the light instead of reading it. REQUIRES: a
    // step that is ready for the scene.
    struct Prepared {
        const FrameContent& content;
        std::unique_ptr<GpuList> list;
        glm::dvec3 midEye;
    };
    Prepared prepare(const FrameContent& content, const GpuStep& step, std::span<const View> eyes);
    void drawEye(const Prepared& frame, const View& eye);  // its light is then in targets()
    // An eye that sees nothing but placards.
    void drawPlacards(std::span<const Placard> placards, const glm::dvec3& background,
                      const View& eye);
    const Targets& targets() const { return *targets_; }

    struct Counts {
        std::uint64_t orders = 0, uploads = 0, eyes = 0;
    };
    Counts counts() const { return {orders_, splatter_.counts().uploads, eyes_}; }

 private:
    void ready(glm::ivec2 size);
    // What hides splats.
    struct Occluders {
        const FlatMesh& behind;
        std::span<const Placard> placards;
    };
    // Leaves the depth attachment, which all planes and the light share, holding these alone.
    void drawDepth(const Occluders& occluders, const View& view, GLuint framebuffer);
    void drawSplats(const GpuList& list, const View& view, const Occluders& occluders);
    // Into plane i, which is cleared.
    void drawPlane(const GpuList& list, const View& view, Channels channels, std::size_t layer,
                   std::size_t i);
    void resolve(const Scene& scene, const PixelBox& covered);
    const gl::Program& resolveProgram(const Scene& scene);
    std::vector<float> opticalDepth(const GpuList& list, const View& view, const FlatMesh& behind);

    std::array<FontStyle, 2> styles_;  // that font_ holds
    Font font_;
    std::unique_ptr<FlatPass> flat_;
    GlSplatter splatter_;
    std::map<int, gl::Program> resolve_;  // by the number of layers; -1 for an ordered scene
    PlacardPass placards_;
    gl::VertexArray noVertices_;
    std::unique_ptr<Targets> targets_;
    bool onProcessor_ = gl::drawsOnProcessor();
    std::vector<float> opaqueDepth_;  // what drawDepth() left, once sumRows() has needed it
    std::uint64_t orders_ = 0, eyes_ = 0;
};

}  // namespace render
