// The pixels of one eye on the GPU.
#pragma once

#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "render/gl/object.h"
#include "render/splat/targets.h"

namespace render {

class GlTargets final : public Targets {
 public:
    // Throws std::runtime_error when the driver cannot hold pictures of this size.
    explicit GlTargets(glm::ivec2 size);

    // RGBA32F, linear, premultiplied; with the opaque scene's depth.
    GLuint lightFramebuffer() const { return light_.id(); }
    // May be wider than size(): the picture is its lower left part.
    const gl::Texture& light() const { return color_; }
    const gl::Texture& depth() const { return depth_; }  // the opaque scene's, likewise

    // Makes plane i of this kind, cleared, and gives its framebuffer; its depth attachment is the
    // opaque scene's.
    GLuint clearedPlane(std::size_t i, Channels channels);
    // Plane i of this kind, holding whatever it held.
    GLuint plane(std::size_t i, Channels channels);
    GLuint planeFramebuffer(std::size_t i) const { return planes_[i]->framebuffer.id(); }
    const gl::Texture& plane(std::size_t i) const { return planes_[i]->texture; }

    std::span<const float> opaqueDepth(std::vector<float>& room) const override;
    void putPlane(std::size_t i, Channels channels, const PixelBox& part,
                  PlanePixels& pixels) override;
    std::vector<float> readScalarPlane(std::size_t i) const override;
    std::span<const float> lightRows(std::vector<float>& room) const override;
    GlTargets& onGl() override { return *this; }

 private:
    struct Plane {
        GLenum format;
        gl::Texture texture;
        gl::Framebuffer framebuffer;
    };
    glm::ivec2 padded_;
    gl::Texture color_, depth_;
    gl::Framebuffer light_;
    std::vector<std::optional<Plane>> planes_;
};

}  // namespace render
