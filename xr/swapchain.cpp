#include "xr/swapchain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

namespace xr {
namespace {

XrSwapchainSubImage lowerLeft(const ImageChain& chain, glm::ivec2 drawn) {
    return {chain.handle(), {{0, 0}, {drawn.x, drawn.y}}, 0};
}

}  // namespace

ImageChain::ImageChain(const Runtime& runtime, XrSession session, std::int64_t format,
                       XrSwapchainUsageFlags usage, glm::ivec2 size)
    : runtime_(&runtime) {
    auto info = typed<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
    info.usageFlags = usage;
    info.format = format;
    info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
    info.width = static_cast<std::uint32_t>(size.x);
    info.height = static_cast<std::uint32_t>(size.y);
    runtime.check(xrCreateSwapchain(session, &info, &handle_), "xrCreateSwapchain");

    std::uint32_t count = 0;
    runtime.check(xrEnumerateSwapchainImages(handle_, 0, &count, nullptr),
                  "xrEnumerateSwapchainImages");
    std::vector<XrSwapchainImageOpenGLKHR> images(
        count, typed<XrSwapchainImageOpenGLKHR>(XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR));
    runtime.check(
        xrEnumerateSwapchainImages(handle_, count, &count,
                                   reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
        "xrEnumerateSwapchainImages");
    for (const XrSwapchainImageOpenGLKHR& image : images) textures_.push_back(image.image);
}

GLuint ImageChain::acquire() {
    const auto acquire = typed<XrSwapchainImageAcquireInfo>(XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO);
    std::uint32_t index = 0;
    runtime_->check(xrAcquireSwapchainImage(handle_, &acquire, &index), "xrAcquireSwapchainImage");
    acquired_ = true;
    auto wait = typed<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
    wait.timeout = Patience{}.calls.count();
    const XrResult result = xrWaitSwapchainImage(handle_, &wait);
    // A time-out is not a failure by its number, but an image that never comes is one.
    runtime_->check(result == XR_TIMEOUT_EXPIRED ? XR_ERROR_RUNTIME_FAILURE : result,
                    "xrWaitSwapchainImage");
    return textures_[index];
}

void ImageChain::release() {
    if (!acquired_) return;
    acquired_ = false;
    const auto release = typed<XrSwapchainImageReleaseInfo>(XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
    runtime_->check(xrReleaseSwapchainImage(handle_, &release), "xrReleaseSwapchainImage");
}

EyeImages::EyeImages(const Runtime& runtime, XrSession session, glm::ivec2 size,
                     std::int64_t colorFormat, std::int64_t depthFormat)
    : size_(size),
      color_(runtime, session, colorFormat,
             XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT, size) {
    if (depthFormat != 0)
        depth_.emplace(runtime, session, depthFormat,
                       XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, size);
}

GLuint EyeImages::acquire() {
    const GLuint color = color_.acquire();
    const GLuint depth = depth_ ? depth_->acquire() : 0;
    const auto [entry, isNew] =
        framebuffers_.try_emplace({color, depth}, std::span(&color, 1), depth);
    return entry->second.id();
}

void EyeImages::release() {
    color_.release();
    if (depth_) depth_->release();
}

XrSwapchainSubImage EyeImages::color(glm::ivec2 drawn) const { return lowerLeft(color_, drawn); }

std::optional<XrSwapchainSubImage> EyeImages::depth(glm::ivec2 drawn) const {
    if (!depth_) return std::nullopt;
    return lowerLeft(*depth_, drawn);
}

ImageFormats imageFormats(const Runtime& runtime, XrSession session) {
    std::uint32_t count = 0;
    runtime.check(xrEnumerateSwapchainFormats(session, 0, &count, nullptr),
                  "xrEnumerateSwapchainFormats");
    std::vector<std::int64_t> offered(count);
    runtime.check(xrEnumerateSwapchainFormats(session, count, &count, offered.data()),
                  "xrEnumerateSwapchainFormats");
    const auto has = [&](std::int64_t format) { return std::ranges::count(offered, format) > 0; };
    if (!has(GL_SRGB8_ALPHA8))
        throw LostError(
            fmt::format("the headset's runtime {} takes no sRGB images of 8 bits", runtime.name()));
    ImageFormats formats{GL_SRGB8_ALPHA8, 0};
    if (runtime.has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME)) {
        constexpr std::array<std::int64_t, 3> kDepths{GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8,
                                                      GL_DEPTH_COMPONENT16};
        const auto found = std::ranges::find_if(kDepths, has);
        if (found != kDepths.end()) formats.depth = *found;
    }
    return formats;
}

}  // namespace xr
