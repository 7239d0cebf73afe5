#include "render/annotate/flat_pass.h"

#include <cstddef>

#include "render/shader_sources.h"

namespace render {

FlatPass::FlatPass(const Font& font)
    : program_("flat", shaders::flat_vert, shaders::flat_frag), atlas_(GL_R8, font.atlasSize()) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(atlas_.id(), 0, 0, 0, font.atlasSize().x, font.atlasSize().y, GL_RED,
                        GL_UNSIGNED_BYTE, font.atlas().data());
}

void FlatPass::draw(const FlatMesh& mesh, GLuint framebuffer, glm::ivec2 size,
                    gl::DepthTest depth) const {
    gl::begin({.framebuffer = framebuffer,
               .size = size,
               .blend = gl::Blend::Premultiplied,
               .depth = depth});
    drawTriangles(mesh, size, 0);
}

void FlatPass::drawDepth(const FlatMesh& mesh, GLuint framebuffer, glm::ivec2 size) const {
    gl::begin({.framebuffer = framebuffer,
               .size = size,
               .clearDepth = 1.0f,
               .depth = gl::DepthTest::TestAndWrite,
               .colorWrite = false});
    drawTriangles(mesh, size, 0.5f);
}

void FlatPass::drawTriangles(const FlatMesh& mesh, glm::ivec2 size, float leastCoverage) const {
    if (mesh.triangles().empty()) return;
    const gl::Buffer vertices{std::span<const FlatVertex>(mesh.triangles())};
    gl::VertexArray array;
    constexpr GLsizei kStride = sizeof(FlatVertex);
    array.attach({0, vertices, 3, GL_FLOAT, kStride, offsetof(FlatVertex, at)});
    array.attach({1, vertices, 4, GL_FLOAT, kStride, offsetof(FlatVertex, color)});
    array.attach({2, vertices, 2, GL_FLOAT, kStride, offsetof(FlatVertex, texel)});
    array.attach({3, vertices, 2, GL_FLOAT, kStride, offsetof(FlatVertex, edge)});
    glUseProgram(program_.id());
    glUniform2f(0, static_cast<float>(size.x), static_cast<float>(size.y));
    glUniform1f(1, leastCoverage);
    glBindTextureUnit(0, atlas_.id());
    glBindVertexArray(array.id());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(mesh.triangles().size()));
}

}  // namespace render
