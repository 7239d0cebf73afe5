// Several rays a pixel on the GPU (render/model/rays_across.h): part by part of the picture a finer
// one is summed, and the pixels of a plane become the means of their rays.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "render/gl/object.h"
#include "render/model/covered.h"

namespace render {

class GlRayMeans {
 public:
    // Of a plane of this format. A part takes no more memory than these bytes, or one row does.
    GlRayMeans(const PixelBox& pixels, GLenum format, int raysAcross, std::uint64_t mostBytes);

    int raysAcross() const { return raysAcross_; }
    const std::vector<PixelBox>& parts() const { return parts_; }  // of the picture's pixels
    // Of a part's finer picture, cleared.
    GLuint cleared(const PixelBox& part);
    GLuint framebuffer() const { return framebuffer_.id(); }
    // Puts the means of that into the part of a plane of this framebuffer.
    void putMeans(const PixelBox& part, GLuint plane, const gl::Program& mean,
                  const gl::VertexArray& nothing);

 private:
    int raysAcross_;
    std::vector<PixelBox> parts_;
    gl::Texture rays_;
    gl::Framebuffer framebuffer_;
};

}  // namespace render
