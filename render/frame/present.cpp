#include "render/frame/present.h"

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <thread>

#include "render/gl/pass.h"
#include "render/image/encode_srgb.h"
#include "render/shader_sources.h"

namespace render {

Present::Present(bool onProcessor)
    : onProcessor_(onProcessor),
      encode_("present", shaders::viewport_vert, shaders::present_frag, "#define ENCODE\n"),
      copy_("present", shaders::viewport_vert, shaders::present_frag, "#define DEPTH\n"),
      scale_("present", shaders::viewport_vert, shaders::present_frag,
             "#define ENCODE\n#define SCALED\n") {}

void Present::draw(Targets& shown, GLuint framebuffer, glm::ivec2 at, Encoding encoding) const {
    const bool toHeadset = encoding == Encoding::Framebuffer;
    if (!shown.srgb8().empty()) return drawBytes(shown.srgb8(), shown.size(), framebuffer, at);
    const GlTargets& light = shown.onGl();
    if (!toHeadset && onProcessor_) return drawHere(light, framebuffer, at);
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

// The light stands before an opaque ground: its alpha is 1 but for rounding.
void Present::drawHere(const GlTargets& light, GLuint framebuffer, glm::ivec2 at) const {
    const glm::ivec2 size = light.size();
    light.lightRows(light_);
    encoded_.resize(light_.size());
    const std::size_t half = light_.size() / 8 * 4;
    {
        const std::jthread other([&] {
            encodeSrgb8(std::span(light_).subspan(half), std::span(encoded_).subspan(half));
        });
        encodeSrgb8(std::span(light_).first(half), std::span(encoded_).first(half));
    }
    for (std::size_t i = 3; i < encoded_.size(); i += 4) encoded_[i] = 255;
    drawBytes(encoded_, size, framebuffer, at);
}

void Present::drawBytes(std::span<const std::uint8_t> bytes, glm::ivec2 size, GLuint framebuffer,
                        glm::ivec2 at) const {
    if (!bytes_ || bytes_->size() != size) bytes_.emplace(size);
    bytes_->write(bytes);
    gl::begin({.framebuffer = framebuffer, .size = size, .at = at});
    glBlitNamedFramebuffer(bytes_->framebuffer(), framebuffer, 0, 0, size.x, size.y, at.x, at.y,
                           at.x + size.x, at.y + size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Present::drawScaled(Targets& shown, GLuint framebuffer, glm::ivec2 at, glm::ivec2 size) const {
    const GlTargets& light = shown.onGl();
    gl::begin({.framebuffer = framebuffer, .size = size, .at = at});
    glUseProgram(scale_.id());
    glUniform2i(0, at.x, at.y);
    glUniform2i(1, size.x, size.y);
    glUniform2i(2, light.size().x, light.size().y);
    glBindTextureUnit(0, light.light().id());
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

Fitted fittedInto(glm::ivec2 window, glm::ivec2 picture) {
    const glm::dvec2 ratio = glm::dvec2(window) / glm::dvec2(picture);
    const double scale = std::min(ratio.x, ratio.y);
    const glm::ivec2 size =
        glm::clamp(glm::ivec2(glm::round(scale * glm::dvec2(picture))), glm::ivec2(1), window);
    return {(window - size) / 2, size};
}

}  // namespace render
