// Every draw and clear states all the fixed-function state it depends on; nothing is restored.
#pragma once

#include <epoxy/gl.h>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace render::gl {

enum class Blend { None, Add, Premultiplied };
enum class DepthTest { None, Test, TestAndWrite };

struct Pass {
    GLuint framebuffer = 0;
    glm::ivec2 size{0};  // drawn pixels: the scissor
    glm::ivec2 at{0};    // their lower left corner
    int guard = 0;       // the viewport reaches this far beyond them on every side
    std::optional<glm::vec4> clearColor = {};  // every colour attachment
    std::optional<float> clearDepth = {};
    Blend blend = Blend::None;
    DepthTest depth = DepthTest::None;
    bool colorWrite = true;
    bool srgbWrite = false;
};

void begin(const Pass& pass);

}  // namespace render::gl
