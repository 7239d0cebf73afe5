// The pixels of one eye: the opaque scene, the planes that splats add up in, and the finished
// light.
#pragma once

#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "render/covered.h"
#include "render/gl/object.h"
#include "render/image.h"
#include "render/scene.h"

namespace render {

class Targets {
 public:
    // Throws std::runtime_error when the driver cannot hold pictures of this size.
    explicit Targets(glm::ivec2 size);

    glm::ivec2 size() const { return size_; }
    // RGBA32F, linear, premultiplied; with the opaque scene's depth.
    GLuint lightFramebuffer() const { return light_.id(); }
    // May be wider than size(): the picture is its lower left part.
    const gl::Texture& light() const { return color_; }
    const gl::Texture& depth() const { return depth_; }  // the opaque scene's, likewise

    // Makes plane i of this kind, cleared, and gives its framebuffer; its depth attachment is the
    // opaque scene's.
    GLuint clearedPlane(std::size_t i, Channels channels);
    // The same, holding whatever it held.
    GLuint plane(std::size_t i, Channels channels);
    GLuint planeFramebuffer(std::size_t i) const { return planes_[i]->framebuffer.id(); }
    const gl::Texture& plane(std::size_t i) const { return planes_[i]->texture; }

    // Of the opaque scene, row 0 at the bottom; into memory that may be used again.
    void readDepth(std::vector<float>& rows) const;
    // A part of plane i, row 0 at the bottom.
    void writePlane(std::size_t i, const PixelBox& part, std::span<const float> pixels);

    Image readLight() const;
    // As GL has it, row 0 at the bottom, four floats a pixel; into memory that may be used again.
    void readLight(std::vector<float>& rows) const;
    // Row 0 at the top, as in Image. REQUIRES: plane i is Weight or Count.
    std::vector<float> readScalarPlane(std::size_t i) const;

 private:
    struct Plane {
        GLenum format;
        gl::Texture texture;
        gl::Framebuffer framebuffer;
    };
    glm::ivec2 size_, padded_;
    gl::Texture color_, depth_;
    gl::Framebuffer light_;
    std::vector<std::optional<Plane>> planes_;
};

}  // namespace render
