// One frame's draw list on the GPU: what GlSplatter::upload makes and GlSplatter::draw draws.
#pragma once

#include <optional>

#include "render/gl_splatter.h"

namespace render {

class GpuList {
 public:
    // Both must outlive the list. REQUIRES: a step that is ready for the scene.
    GpuList(const Scene& scene, const DrawList& list, const GpuStep& step, const ValueScale& scale);

    const Scene& scene() const { return scene_; }
    const GpuStep& step() const { return step_; }
    bool cubes() const { return cubes_; }

    // Issues the draw calls of one layer, or of all; program and state are set. A Sorted list is
    // always drawn whole.
    void draw(bool quads, std::optional<std::size_t> layer) const;

 private:
    void drawSorted(bool quads) const;

    const Scene& scene_;
    const GpuStep& step_;
    bool cubes_;
    std::optional<gl::Buffer> sorted_;  // SortedPoint, farthest first
    GLsizei sortedCount_ = 0;
    gl::VertexArray points_, quads_;  // per vertex and per instance
};

}  // namespace render
