#include "render/splat/memory_targets.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "render/splat/gl_targets.h"
#include "render/together.h"
#include "timeseries/grid/pages.h"

namespace render {
namespace {

// Fewer are turned over before another thread has begun.
constexpr std::size_t kPixelsWorthAThread = 1 << 17;

}  // namespace

MemoryTargets::MemoryTargets(glm::ivec2 size) : Targets(size) {}
MemoryTargets::~MemoryTargets() = default;

std::size_t MemoryTargets::pixels() const {
    return static_cast<std::size_t>(size().x) * static_cast<std::size_t>(size().y);
}

std::span<float> MemoryTargets::linearLight() {
    srgb8_.clear();
    if (linear_.size() != pixels()) {
        linear_ = {};
        timeseries::resizePopulated(linear_, pixels());
    }
    return {&linear_.data()->x, 4 * linear_.size()};
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

std::span<const float> MemoryTargets::lightRows(std::vector<float>&) const {
    if (linear_.empty()) return {};
    return {&linear_.data()->x, 4 * linear_.size()};
}

// Without a copy: a page that is new costs more than its rows' turning over.
Image MemoryTargets::takeLight() {
    Image image;
    image.size = size();
    image.pixels = std::exchange(linear_, {});
    const auto width = static_cast<std::ptrdiff_t>(size().x);
    const auto row = [&](std::size_t y) {
        return image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * width;
    };
    const auto height = static_cast<std::size_t>(size().y);
    inParts(height / 2, threadsFor(pixels(), kPixelsWorthAThread),
            [&](std::size_t first, std::size_t last) {
                for (std::size_t y = first; y < last; ++y)
                    std::swap_ranges(row(y), row(y + 1), row(height - 1 - y));
            });
    return image;
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
    if (linear_.size() == pixels())
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
