// One frame's draw list on the GPU: what GlSplatter::upload makes and GlSplatter::draw draws.
#pragma once

#include <memory>
#include <span>

#include "render/splat/gl_depth_order.h"
#include "render/splat/gl_splatter.h"
#include "render/splat/pieces.h"

namespace render {

class GlList {
 public:
    // Of the scene's runs. Scene and step must outlive the list. REQUIRES: a step that is ready for
    // the scene.
    GlList(const Scene& scene, const GlStep& step);
    // Of a list in order.
    GlList(const Scene& scene, const GlStep& step, GlDepthOrder::List list);

    const Scene& scene() const { return scene_; }
    const GlStep& step() const { return step_; }
    bool cubes() const { return cubes_; }

    // What makes up a plane, in the order of drawing; see GlSplatter::draw.
    std::span<const Piece> pieces(Channels channels, std::size_t layer) const;
    bool isSorted() const { return sorted_ != nullptr; }
    // Issue the draw calls of some that follow each other; program and state are set. Of quads,
    // `corners` has the elements of kPiecePoints: two triangles each over corners 4 i to 4 i + 3.
    void drawSprites(std::span<const Piece> pieces) const;
    void drawQuads(std::span<const Piece> pieces, const gl::VertexArray& corners) const;

 private:
    const Scene& scene_;
    const GlStep& step_;
    bool cubes_;
    std::vector<Piece> pieces_;
    std::shared_ptr<const gl::Buffer> sorted_;  // SortedPoint, farthest first; none: the step's own
    gl::VertexArray points_;
};

}  // namespace render
