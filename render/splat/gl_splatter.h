// The splatter on GL 4.5: a draw list is uploaded once a frame, and drawn once an eye.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>

#include "render/gl/object.h"
#include "render/splat/depth_order.h"
#include "render/splat/gl_depth_order.h"
#include "render/splat/pieces.h"
#include "render/splat/splatter.h"

namespace render {

// One frame's list, ready to draw for any number of eyes.
class GlList;

// What tells a fragment shader which channels it accumulates.
const char* defineOf(Channels channels);

class GlSplatter final : public Splatter {
 public:
    // `mostSorted`: bytes of a list that the GPU puts in order; a larger one is made here.
    explicit GlSplatter(std::uint64_t mostSorted = GlDepthOrder::mostBytes());
    ~GlSplatter() override;
    // Whether the driver lets vertex shaders read what they need: GL 4.5 promises none of it.
    static bool canDraw();

    // The GPU's own, if there is an order.
    DrawList order(const Scene& scene, const glm::dvec3& midEye) override;
    // Whether the GPU makes the list of this scene, which is ordered, of what lies there. Else it
    // is made here, in one go by prepare().
    bool sortsOnGpu(const Scene& scene, const GlStep& step) const {
        return orderOnGpu_.fits(scene, step);
    }
    std::unique_ptr<SplatFrame> prepare(const Scene& scene, DrawList list,
                                        const GlStep& step) override;
    std::uint64_t bytes() const { return orderOnGpu_.bytes(); }  // for order, on the GPU
    // What resolving a frame's planes needs, whoever sums them; upload() does it.
    void setLayers(const Scene& scene, const ValueScale& scale);

    // Once a frame. `step` holds the scene's step and is ready for it. The list refers to both.
    std::unique_ptr<GlList> upload(const Scene& scene, const DrawList& list, const GlStep& step);

    // Once an eye: adds one plane into a framebuffer whose one colour attachment is of that kind
    // (R32F or RGBA32F) and whose depth attachment is the opaque scene's, tested, not written.
    // `layer` is the plane's layer for Weight and WeightedColor. Clears nothing.
    void draw(const GlList& list, const View& view, Channels channels, std::size_t layer,
              GLuint framebuffer);
    // Adds some of the plane's pieces, list.pieces(channels, layer).
    void draw(const GlList& list, const View& view, Channels channels,
              std::span<const Piece> pieces, GLuint framebuffer);

    // How often each was called: two eyes are one list drawn twice.
    struct Counts {
        std::uint64_t uploads = 0, draws = 0;
    };
    const Counts& counts() const { return counts_; }
    const gl::Buffer& layerBlock() const { return layers_; }
    const gl::Texture& colorMaps() const {
        return colorMaps_;
    }  // a row a layer, then sumsOf() them

 private:
    struct Variant {
        Channels channels;
        Kernel kernel;
        bool quads, sorted, cubes, cut, mesh;
        auto operator<=>(const Variant&) const = default;
    };
    const gl::Program& program(const Variant& variant);
    std::unique_ptr<GlList> listOnGpu(const Scene& scene, const glm::dvec3& midEye,
                                      const GlStep& step);
    std::unique_ptr<GlList> send(const Scene& scene, const Sorted& list, const GlStep& step);

    std::map<Variant, gl::Program> programs_;  // compiled when first drawn with
    gl::Buffer view_, layers_;
    gl::Texture colorMaps_;
    gl::Buffer elements_;
    gl::VertexArray corners_;        // GlList::drawQuads
    float largestPoint_ = 1;         // side in pixels
    glm::ivec2 largestViewport_{0};  // a larger one is cut without a word
    Counts counts_;
    GlDepthOrder orderOnGpu_;
    DepthOrder order_;
};

}  // namespace render
