// Draws FlatMeshes with a font's atlas.
#pragma once

#include "render/annotate/flat_mesh.h"
#include "render/gl/object.h"
#include "render/gl/pass.h"

namespace render {

class FlatPass {
 public:
    explicit FlatPass(const Font& font);

    // Blends the mesh over what is there; with DepthTest::Test, where nothing nearer is.
    void draw(const FlatMesh& mesh, GLuint framebuffer, glm::ivec2 size,
              gl::DepthTest depth = gl::DepthTest::None) const;
    // Makes the depth attachment hold the mesh alone: where it covers more than half of a pixel, or
    // its soft edges would cut what lies just behind them.
    void drawDepth(const FlatMesh& mesh, GLuint framebuffer, glm::ivec2 size) const;

 private:
    void drawTriangles(const FlatMesh& mesh, glm::ivec2 size, float leastCoverage) const;

    gl::Program program_;
    gl::Texture atlas_;
};

}  // namespace render
