// One frame for any number of eyes: opaque scene, splats, resolve, legend. The draw list is ordered
// and uploaded once and drawn once an eye, whichever front end asks.
#pragma once

#include <array>
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
#include "render/row_splatter.h"
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
    // between the eyes. REQUIRES: at least one eye. Throws std::runtime_error on a GL error.
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
    // One of the eyes that the frame was prepared for; its light is then in targets().
    void drawEye(const Prepared& frame, const View& eye);
    // The same bit for bit over several frames, in which nothing else is drawn. Frame and view must
    // outlive it.
    struct EyeInWork {
        const Prepared& frame;
        const View& eye;
        FlatMesh legend;
        AxesMeshes axes;
        std::size_t plane = 0, piece = 0;  // to be drawn next
        std::uint64_t cost = 0;            // drawn so far, in splats
        // Where the driver draws on the processor: the opaque scene, and the plane being summed.
        std::vector<float> opaqueDepth = {};
        std::optional<RowSum> rows = {};
    };
    EyeInWork begin(const Prepared& frame, const View& eye);
    // Draws until `splats` are reached: one piece (render/pieces.h) at least, or RowSum::kLeast.
    // True when the light is in targets(); before, there is nothing to see.
    bool goOn(EyeInWork& work, std::uint64_t splats);
    std::uint64_t cost(const Prepared& frame) const;  // of a whole eye
    // An eye that sees nothing but placards. REQUIRES: makeRoom() for it.
    void drawPlacards(std::span<const Placard> placards, const glm::dvec3& background,
                      const View& eye);
    // Keeps targets of these eyes' sizes, and no others; prepare() does that.
    void makeRoom(std::span<const View> eyes);
    const Targets& targets() const { return *targets_[current_]; }  // of the eye drawn last

    struct Counts {
        std::uint64_t orders = 0, uploads = 0, eyes = 0;
    };
    Counts counts() const { return {orders_, splatter_.counts().uploads, eyes_}; }

 private:
    Targets& use(glm::ivec2 size);  // which targets() then are
    // What hides splats.
    struct Occluders {
        const FlatMesh& behind;
        std::span<const Placard> placards;
    };
    // Leaves the depth attachment, which all planes and the light share, holding these alone.
    void drawDepth(const Occluders& occluders, const View& view, GLuint framebuffer);
    bool drawSplats(EyeInWork& work, std::uint64_t splats);
    // Of the plane that is next, until work.cost reaches `until`. True when it is whole.
    bool drawPieces(EyeInWork& work, Channels channels, std::uint64_t until);
    bool drawRows(EyeInWork& work, Channels channels, std::uint64_t until);
    bool byRows(Channels channels) const;
    void drawLight(const EyeInWork& work);
    void resolve(const Scene& scene, const PixelBox& covered);
    const gl::Program& resolveProgram(const Scene& scene);
    std::vector<float> opticalDepth(const GpuList& list, const View& view, const FlatMesh& behind);

    std::array<FontStyle, 2> styles_;  // that font_ holds
    Font font_;
    std::unique_ptr<FlatPass> flat_;
    GlSplatter splatter_;
    std::map<int, gl::Program> resolve_;  // by the number of layers; -1 for an ordered scene
    PlacardPass placards_;
    HiddenAreaPass hidden_;
    gl::VertexArray noVertices_;
    std::vector<std::unique_ptr<Targets>> targets_;  // all of different sizes
    std::size_t current_ = 0;
    bool onProcessor_ = gl::drawsOnProcessor();
    std::uint64_t orders_ = 0, eyes_ = 0;
};

}  // namespace render
