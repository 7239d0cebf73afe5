// Light onto a display: what an eye's targets hold, into a window's framebuffer or a texture.
#pragma once

#include "render/gl/object.h"
#include "render/targets.h"

namespace render {

// Who encodes linear light as sRGB: the shader, to the bytes that a PNG has, but for light that
// lies within kBorder steps of the border between two bytes, which may become either (GLSL's pow is
// a float's); or GL, where the framebuffer's format is an sRGB one (a headset's swapchain). Such a
// framebuffer's depth, where it has one, becomes the opaque scene's; pixels that nobody sees (View)
// become black, and as far away as can be, so that no reprojection draws them over others.
enum class Encoding { Shader, Framebuffer };

class Present {
 public:
    static constexpr double kBorder = 0.002;  // steps of 1 / 255
    Present();
    // Replaces the pixels of `framebuffer` from `at` (its lower left corner) to at + light.size().
    // Alpha becomes 1: the light's ground is opaque.
    void draw(const Targets& light, GLuint framebuffer, glm::ivec2 at = {0, 0},
              Encoding encoding = Encoding::Shader) const;

 private:
    gl::Program encode_, copy_;
    gl::VertexArray noVertices_;
};

}  // namespace render
