#include "render/splat/gl_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "render/gl/pass.h"

namespace render {
namespace {

// Rows of 4096 bytes fall on the same cache sets, which more than doubles the time of llvmpipe's
// blending: rows are made a little longer than the picture.
glm::ivec2 padded(glm::ivec2 size) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (size.x < 1 || size.y < 1 || size.x > largest || size.y > largest)
        throw std::runtime_error(fmt::format(
            "a picture of {} x {} pixels is not between 1 and this GL driver's {} a side", size.x,
            size.y, largest));
    const int wider = size.x % 256 == 0 ? size.x + 16 : size.x;
    return {std::min(wider, largest), size.y};
}

std::vector<GLuint> ids(const gl::Texture& texture) { return {texture.id()}; }

template <typename T>
void readPixels(GLuint framebuffer, glm::ivec2 size, GLenum format, std::vector<T>& into) {
    into.resize(std::size_t(size.x) * std::size_t(size.y) * (format == GL_RGBA ? 4 : 1) *
                sizeof(float) / sizeof(T));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x, size.y, format, GL_FLOAT, into.data());
}

}  // namespace

GlTargets::GlTargets(glm::ivec2 size) try
    : Targets(size),
      padded_(padded(size)),
      color_(GL_RGBA32F, padded_),
      depth_(GL_DEPTH_COMPONENT32F, padded_),
      light_(ids(color_), depth_.id()) {
} catch (const std::runtime_error& error) {
    // Most often memory: the driver's own words do not say for what.
    throw std::runtime_error(
        fmt::format("no room for a picture of {} x {} pixels: {}", size.x, size.y, error.what()));
}

GLuint GlTargets::plane(std::size_t i, Channels channels) {
    const bool scalar = channels == Channels::Weight || channels == Channels::Count;
    const GLenum format = scalar ? GL_R32F : GL_RGBA32F;
    if (planes_.size() <= i) planes_.resize(i + 1);
    if (!planes_[i] || planes_[i]->format != format) {
        gl::Texture texture(format, padded_);
        gl::Framebuffer framebuffer(ids(texture), depth_.id());
        planes_[i].emplace(Plane{format, std::move(texture), std::move(framebuffer)});
    }
    return planes_[i]->framebuffer.id();
}

GLuint GlTargets::clearedPlane(std::size_t i, Channels channels) {
    const GLuint framebuffer = plane(i, channels);
    gl::begin({.framebuffer = framebuffer, .size = size(), .clearColor = glm::vec4(0)});
    return framebuffer;
}

std::span<const float> GlTargets::opaqueDepth(std::vector<float>& room) const {
    readPixels(light_.id(), size(), GL_DEPTH_COMPONENT, room);
    return room;
}

void GlTargets::putPlane(std::size_t i, Channels channels, const PixelBox& part,
                         PlanePixels& pixels) {
    plane(i, channels);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(planes_[i]->texture.id(), 0, part.at.x, part.at.y, part.size.x, part.size.y,
                        planes_[i]->format == GL_R32F ? GL_RED : GL_RGBA, GL_FLOAT, pixels.data());
}

std::span<const float> GlTargets::lightRows(std::vector<float>& room) const {
    readPixels(light_.id(), size(), GL_RGBA, room);
    return room;
}

std::vector<float> GlTargets::readScalarPlane(std::size_t i) const {
    std::vector<float> rows;
    readPixels(planes_[i]->framebuffer.id(), size(), GL_RED, rows);
    return turnedOver(std::move(rows), size());
}

}  // namespace render
