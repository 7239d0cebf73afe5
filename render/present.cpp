#include "render/present.h"

#include <cmath>
#include <limits>

#include "render/color.h"
#include "render/gl/pass.h"
#include "render/shader_sources.h"

namespace render {
namespace {

// Rounded up: a float lies above a step's bound exactly when it is at least this.
std::array<float, 255> steps() {
    std::array<float, 255> rounded{};
    for (std::size_t i = 0; i < rounded.size(); ++i) {
        const double bound = srgb8Steps()[i];
        rounded[i] = static_cast<float>(bound);
        if (static_cast<double>(rounded[i]) < bound)
            rounded[i] = std::nextafter(rounded[i], std::numeric_limits<float>::infinity());
    }
    return rounded;
}

}  // namespace

Present::Present()
    : encode_("present", shaders::viewport_vert, shaders::present_frag, "#define ENCODE\n"),
      copy_("present", shaders::viewport_vert, shaders::present_frag, "#define DEPTH\n"),
      steps_(std::span<const float>(steps())),
      stepsTexture_(GL_R32F, steps_) {}

void Present::draw(const Targets& light, GLuint framebuffer, glm::ivec2 at,
                   Encoding encoding) const {
    const bool toHeadset = encoding == Encoding::Framebuffer;
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
    glBindTextureUnit(2, light.depth().id());
    glBindTextureUnit(1, stepsTexture_.id());
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace render
