#include "render/gl/pass.h"

namespace render::gl {
namespace {

void enable(GLenum what, bool on) { (on ? glEnable : glDisable)(what); }

}  // namespace

void begin(const Pass& pass) {
    glBindFramebuffer(GL_FRAMEBUFFER, pass.framebuffer);
    glViewport(pass.at.x - pass.guard, pass.at.y - pass.guard, pass.size.x + 2 * pass.guard,
               pass.size.y + 2 * pass.guard);
    glScissor(pass.at.x, pass.at.y, pass.size.x, pass.size.y);
    glEnable(GL_SCISSOR_TEST);
    // Window y upwards, clip depth [0, 1]: as View states.
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_MULTISAMPLE);
    glDisable(GL_DITHER);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_LOWER_LEFT);
    const GLboolean color = pass.colorWrite ? GL_TRUE : GL_FALSE;
    glColorMask(color, color, color, color);
    enable(GL_FRAMEBUFFER_SRGB, pass.srgbWrite);
    enable(GL_BLEND, pass.blend != Blend::None);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, pass.blend == Blend::Premultiplied ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
    // A depth clear needs the mask open.
    glDepthMask(GL_TRUE);
    if (pass.clearColor) {
        const glm::vec4& c = *pass.clearColor;
        glClearColor(c.r, c.g, c.b, c.a);
    }
    if (pass.clearDepth) glClearDepthf(*pass.clearDepth);
    const GLbitfield clears =
        (pass.clearColor ? GL_COLOR_BUFFER_BIT : 0u) | (pass.clearDepth ? GL_DEPTH_BUFFER_BIT : 0u);
    if (clears != 0) glClear(clears);
    enable(GL_DEPTH_TEST, pass.depth != DepthTest::None);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(pass.depth == DepthTest::TestAndWrite);
}

}  // namespace render::gl
