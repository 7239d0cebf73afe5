// An image of a headset's swapchain, as a runtime hands one out, without a runtime.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "render/gl/object.h"

namespace tests {

struct EyeImage {
    explicit EyeImage(glm::ivec2 size)
        : color(GL_SRGB8_ALPHA8, size), depth(GL_DEPTH_COMPONENT32F, size) {}

    // Of the lower left `drawn` pixels; as drawn, from the top.
    std::vector<glm::u8vec4> pixels(glm::ivec2 drawn) const {
        std::vector<glm::u8vec4> all(std::size_t(drawn.x) * drawn.y), rows;
        glGetTextureSubImage(color.id(), 0, 0, 0, 0, drawn.x, drawn.y, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                             static_cast<GLsizei>(all.size() * 4), all.data());
        for (int y = drawn.y - 1; y >= 0; --y)
            rows.insert(rows.end(), all.begin() + y * drawn.x, all.begin() + (y + 1) * drawn.x);
        return rows;
    }
    float depthAt(glm::ivec2 at) const {
        float value = 0;
        glGetTextureSubImage(depth.id(), 0, at.x, at.y, 0, 1, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                             sizeof value, &value);
        return value;
    }

    render::gl::Texture color, depth;
    render::gl::Framebuffer framebuffer{std::array{color.id()}, depth.id()};
};

}  // namespace tests
