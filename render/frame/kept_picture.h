// A finished picture kept on the GPU, to be shown again while only what lies over it changes.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "render/gl/object.h"

namespace render {

// Needs a current GL context, from construction to destruction.
class KeptPicture {
 public:
    explicit KeptPicture(glm::ivec2 size);
    glm::ivec2 size() const { return texture_.size(); }
    // sRGB bytes, row 0 at the bottom; to draw into.
    GLuint framebuffer() const { return framebuffer_.id(); }
    // Its pixels from `at` (lower left corner) to at + size, row 0 at the bottom.
    void write(std::span<const std::uint8_t> rgba, glm::ivec2 at, glm::ivec2 size);
    // Clears the window's own framebuffer to `ground` (sRGB) and copies the picture into it, lower
    // left corner at `at`.
    void show(glm::ivec2 window, glm::ivec2 at, const glm::vec3& ground) const;

 private:
    gl::Texture texture_;
    gl::Framebuffer framebuffer_;
};

// Only the ground, while there is no picture.
void showGround(glm::ivec2 window, const glm::vec3& ground);

}  // namespace render
