#include "render/frame/present.h"

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <thread>

#include "render/image/encode_srgb.h"
#include "render/shader_sources.h"

namespace render {

namespace {

constexpr const char* kEncode = "#define ENCODE\n";
constexpr const char* kWithDepth = "#define DEPTH\n";
constexpr const char* kScaled = "#define ENCODE\n#define SCALED\n";

}  // namespace

Present::Present(bool onProcessor) : onProcessor_(onProcessor) {}

const gl::Program& Present::program(const char* defines) const {
    const auto found = programs_.find(defines);
    if (found != programs_.end()) return found->second;
    return programs_
        .emplace(defines,
                 gl::Program("present", shaders::viewport_vert, shaders::present_frag, defines))
        .first->second;
}

void Present::draw(Targets& shown, KeptPicture& picture, glm::ivec2 at) const {
    if (!shown.srgb8().empty()) return picture.write(shown.srgb8(), at, shown.size());
    const GlTargets& light = shown.onGl();
    if (onProcessor_) return picture.write(encoded(light), at, light.size());
    drawBy(kEncode, {.framebuffer = picture.framebuffer(), .size = light.size(), .at = at}, light);
}

void Present::drawLinear(Targets& shown, GLuint framebuffer) const {
    const GlTargets& light = shown.onGl();
    drawBy(kWithDepth,
           {.framebuffer = framebuffer,
            .size = light.size(),
            .clearDepth = 1.0f,
            .depth = gl::DepthTest::TestAndWrite,
            .srgbWrite = true},
           light);
}

void Present::drawBy(const char* defines, const gl::Pass& pass, const GlTargets& light) const {
    gl::begin(pass);
    glUseProgram(program(defines).id());
    glUniform2i(0, pass.at.x, pass.at.y);
    glBindTextureUnit(0, light.light().id());
    glBindTextureUnit(1, light.depth().id());
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

// The light stands before an opaque ground: its alpha is 1 but for rounding.
std::span<const std::uint8_t> Present::encoded(const GlTargets& light) const {
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
    return encoded_;
}

void Present::drawScaled(Targets& shown, GLuint framebuffer, glm::ivec2 at, glm::ivec2 size) const {
    const GlTargets& light = shown.onGl();
    gl::begin({.framebuffer = framebuffer, .size = size, .at = at});
    glUseProgram(program(kScaled).id());
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
