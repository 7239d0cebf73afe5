#include "render/frame/kept_picture.h"

#include <array>

#include "render/gl/pass.h"

namespace render {

KeptPicture::KeptPicture(glm::ivec2 size)
    : texture_(GL_RGBA8, size), framebuffer_(std::array{texture_.id()}) {}

void KeptPicture::write(std::span<const std::uint8_t> rgba, glm::ivec2 at, glm::ivec2 size) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture_.id(), 0, at.x, at.y, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE,
                        rgba.data());
}

void KeptPicture::show(glm::ivec2 window, glm::ivec2 at, const glm::vec3& ground) const {
    showGround(window, ground);
    glBlitNamedFramebuffer(framebuffer(), 0, 0, 0, size().x, size().y, at.x, at.y, at.x + size().x,
                           at.y + size().y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void showGround(glm::ivec2 window, const glm::vec3& ground) {
    gl::begin({.framebuffer = 0, .size = window, .clearColor = glm::vec4(ground, 1)});
}

}  // namespace render
