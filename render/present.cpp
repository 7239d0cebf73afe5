#include "render/present.h"

#include "render/gl/pass.h"
#include "render/shader_sources.h"

namespace render {

Present::Present()
    : encode_("present", shaders::viewport_vert, shaders::present_frag, "#define ENCODE\n"),
      copy_("present", shaders::viewport_vert, shaders::present_frag) {}

void Present::draw(const Targets& light, GLuint framebuffer, glm::ivec2 at,
                   Encoding encoding) const {
    gl::begin({.framebuffer = framebuffer,
               .size = light.size(),
               .at = at,
               .srgbWrite = encoding == Encoding::Framebuffer});
    glUseProgram(encoding == Encoding::Shader ? encode_.id() : copy_.id());
    glUniform2i(0, at.x, at.y);
    glBindTextureUnit(0, light.light().id());
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace render
