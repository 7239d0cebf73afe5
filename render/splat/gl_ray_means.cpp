#include "render/splat/gl_ray_means.h"

#include <algorithm>
#include <array>

#include "render/gl/pass.h"

namespace render {
namespace {

std::vector<PixelBox> partsOf(const PixelBox& pixels, GLenum format, int raysAcross,
                              std::uint64_t mostBytes) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    const int longest = std::max(largest / raysAcross, 1);
    const int columns = std::clamp(pixels.size.x, 1, longest);
    const std::uint64_t bytesOfRow = static_cast<std::uint64_t>(columns) * raysAcross * raysAcross *
                                     (format == GL_R32F ? 1 : 4) * sizeof(float);
    const auto fit =
        static_cast<int>(std::clamp<std::uint64_t>(mostBytes / bytesOfRow, 1, longest));
    const int rows = std::clamp(fit, 1, std::max(pixels.size.y, 1));
    std::vector<PixelBox> parts;
    for (int y = 0; y < pixels.size.y; y += rows)
        for (int x = 0; x < pixels.size.x; x += columns)
            parts.push_back({pixels.at + glm::ivec2(x, y),
                             glm::min({columns, rows}, pixels.size - glm::ivec2(x, y))});
    return parts;
}

}  // namespace

GlRayMeans::GlRayMeans(const PixelBox& pixels, GLenum format, int raysAcross,
                       std::uint64_t mostBytes)
    : raysAcross_(raysAcross),
      parts_(partsOf(pixels, format, raysAcross, mostBytes)),
      rays_(format, raysAcross * (parts_.empty() ? glm::ivec2(1) : parts_.front().size)),
      framebuffer_(std::array{rays_.id()}) {}

GLuint GlRayMeans::cleared(const PixelBox& part) {
    gl::begin({.framebuffer = framebuffer_.id(),
               .size = raysAcross_ * part.size,
               .clearColor = glm::vec4(0)});
    return framebuffer_.id();
}

void GlRayMeans::putMeans(const PixelBox& part, GLuint plane, const gl::Program& mean,
                          const gl::VertexArray& nothing) {
    gl::begin({.framebuffer = plane, .size = part.size, .at = part.at});
    glUseProgram(mean.id());
    glProgramUniform3i(mean.id(), 0, part.at.x, part.at.y, raysAcross_);
    glBindTextureUnit(0, rays_.id());
    glBindVertexArray(nothing.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace render
