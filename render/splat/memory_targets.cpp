#include "render/splat/memory_targets.h"

#include <algorithm>
#include <cassert>

#include "render/splat/gl_targets.h"

namespace render {

MemoryTargets::MemoryTargets(glm::ivec2 size) : Targets(size) {}
MemoryTargets::~MemoryTargets() = default;

std::size_t MemoryTargets::pixels() const {
    return static_cast<std::size_t>(size().x) * static_cast<std::size_t>(size().y);
}

std::span<float> MemoryTargets::linearLight() {
    srgb8_.clear();
    linear_.resize(4 * pixels());
    return linear_;
}

std::span<std::uint8_t> MemoryTargets::srgb8Light() {
    linear_.clear();
    srgb8_.resize(4 * pixels());
    return srgb8_;
}

void MemoryTargets::putPlane(std::size_t i, Channels channels, const PixelBox& part,
                             PlanePixels& pixels) {
    if (planes_.size() <= i) planes_.resize(i + 1);
    planes_[i].channels = channels;
    planes_[i].part = part;
    planes_[i].pixels.swap(pixels);
}

std::vector<float> MemoryTargets::readScalarPlane(std::size_t i) const {
    const auto& [channels, part, values] = planes_[i];
    assert(channels == Channels::Weight || channels == Channels::Count);
    std::vector<float> rows(pixels());
    for (std::ptrdiff_t y = 0; y < part.size.y; ++y)
        std::copy_n(values.begin() + y * part.size.x, part.size.x,
                    rows.begin() + (part.at.y + y) * size().x + part.at.x);
    return turnedOver(std::move(rows), size());
}

GlTargets& MemoryTargets::onGl() {
    if (!onGl_) onGl_ = std::make_unique<GlTargets>(size());
    if (linear_.size() == 4 * pixels())
        glTextureSubImage2D(onGl_->light().id(), 0, 0, 0, size().x, size().y, GL_RGBA, GL_FLOAT,
                            linear_.data());
    constexpr float kFar = 1;
    if (depth_.empty())
        glClearTexImage(onGl_->depth().id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &kFar);
    else
        glTextureSubImage2D(onGl_->depth().id(), 0, 0, 0, size().x, size().y, GL_DEPTH_COMPONENT,
                            GL_FLOAT, depth_.data());
    return *onGl_;
}

}  // namespace render
