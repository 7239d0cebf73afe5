#include "render/present.h"

#include "render/gl/pass.h"
#include "render/shader_sources.h"

namespace render {

Present::Present()
    : encode_("present", shaders::viewport_vert, shaders::present_frag, "#define ENCODE\n"),
      copy_("present", shaders::viewport_vert, shaders::present_frag, "#define DEPTH\n") {}

void Present::draw(const Targets& light, GLuint framebuffer, glm::ivec2 at,
                   Encoding encoding) const {
    const bool toHeadset = encoding == Encoding::Framebuffer;
    gl::Pass pass{
        .framebuffer = framebuffer, .size = light.size(), .at = at, .srgbWrite = toHeadset};
    if (toHeadset) {
        pass.clearDepth = 1.0f;
        pass.depth = gl::DepthTest::TestAndWrite;
    }
    gl::begin(pass);
    glUseProgram(toHeadset ? copy_.id() : encode_.id());
    glUniform2i(0, at.x, at.y);
    glBindTextureUnit(0, light.light().id());
    glBindTextureUnit(1, light.depth().id());
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace render
