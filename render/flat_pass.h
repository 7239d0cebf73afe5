// Draws FlatMeshes with a font's atlas.
#pragma once

#include "render/flat_mesh.h"
#include "render/gl/object.h"
#include "render/gl/pass.h"

namespace render {

class FlatPass {
 public:
    explicit FlatPass(const Font& font);

    // Blends the mesh over what is there. With DepthTest::TestAndWrite its depths count too.
    void draw(const FlatMesh& mesh, GLuint framebuffer, glm::ivec2 size, gl::DepthTest depth) const;

 private:
    gl::Program program_;
    gl::Texture atlas_;
};

}  // namespace render
