// The images that one eye draws into: colour, and depth where the runtime takes it.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "render/gl/object.h"
#include "xr/api.h"
#include "xr/runtime.h"

namespace xr {

// A chain of images of one format, made with the session, destroyed with it.
class ImageChain {
 public:
    ImageChain(const Runtime& runtime, XrSession session, std::int64_t format,
               XrSwapchainUsageFlags usage, glm::ivec2 size);

    XrSwapchain handle() const { return handle_; }
    // The texture to draw into, until release(). REQUIRES: released.
    GLuint acquire();
    void release();
    bool acquired() const { return acquired_; }

 private:
    const Runtime* runtime_;
    XrSwapchain handle_ = XR_NULL_HANDLE;
    std::vector<GLuint> textures_;
    bool acquired_ = false;
};

class EyeImages {
 public:
    // `depthFormat`: 0 for none. REQUIRES: runtime outlives this.
    EyeImages(const Runtime& runtime, XrSession session, glm::ivec2 size, std::int64_t colorFormat,
              std::int64_t depthFormat);

    glm::ivec2 size() const { return size_; }
    // A framebuffer over the next image, to draw into until release().
    GLuint acquire();
    void release();
    bool acquired() const { return color_.acquired(); }

    // The lower left `drawn` pixels, for the compositor.
    XrSwapchainSubImage color(glm::ivec2 drawn) const;
    std::optional<XrSwapchainSubImage> depth(glm::ivec2 drawn) const;

 private:
    glm::ivec2 size_;
    ImageChain color_;
    std::optional<ImageChain> depth_;
    // By colour and depth texture: the two chains need not turn in step.
    std::map<std::pair<GLuint, GLuint>, render::gl::Framebuffer> framebuffers_;
};

struct ImageFormats {
    std::int64_t color, depth;  // GL names; depth 0 when the runtime takes none
};
// The runtime's first format is not the one that is wanted: colour is sRGB of 8 bits, depth as
// precise as offered. Throws LostError when there is no such colour.
ImageFormats imageFormats(const Runtime& runtime, XrSession session);

}  // namespace xr
