// Light onto a display: what an eye's targets hold, into a picture to be shown or a swapchain.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "render/frame/kept_picture.h"
#include "render/gl/driver.h"
#include "render/gl/object.h"
#include "render/gl/pass.h"
#include "render/splat/gl_targets.h"

namespace render {

// The largest rectangle of a picture's shape in a window, in its middle.
struct Fitted {
    glm::ivec2 at, size;
};
Fitted fittedInto(glm::ivec2 window, glm::ivec2 picture);

class Present {
 public:
    static constexpr double kBorder = 0.002;  // steps of 1 / 255
    // `onProcessor`: the program's encoding is not done by a shader, which costs a driver that
    // draws there three times as much.
    explicit Present(bool onProcessor = gl::drawsOnProcessor());
    // Replaces the picture's pixels from `at` (its lower left corner) to at + light.size() by the
    // bytes that a PNG has, but for light that lies within kBorder steps of the border between two
    // bytes, which may become either. Alpha becomes 1: the light's ground is opaque.
    void draw(Targets& light, KeptPicture& picture, glm::ivec2 at = {0, 0}) const;
    // Into a framebuffer of an sRGB format (a headset's swapchain), as which GL encodes it. Its
    // depth, where it has one, becomes the opaque scene's; pixels that nobody sees (View) become
    // black, and as far away as can be, so that no reprojection draws them over others. REQUIRES:
    // linear light.
    void drawLinear(Targets& light, GLuint framebuffer) const;
    // Draws all of the light, `size` pixels large: between pixels of the light, what lies around
    // them.
    void drawScaled(Targets& light, GLuint framebuffer, glm::ivec2 at, glm::ivec2 size) const;

 private:
    std::span<const std::uint8_t> encoded(const GlTargets& light) const;
    void drawBy(const char* defines, const gl::Pass& pass, const GlTargets& light) const;
    const gl::Program& program(const char* defines) const;

    bool onProcessor_;
    mutable std::map<std::string_view, gl::Program> programs_;  // when first drawn with
    gl::VertexArray noVertices_;
    // Kept because new memory costs more than what is done with it.
    mutable std::vector<float> light_;
    mutable std::vector<std::uint8_t> encoded_;
};

}  // namespace render
