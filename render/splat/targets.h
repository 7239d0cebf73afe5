// The pixels of one eye: the opaque scene's depth, the planes that splats add up in, and the
// finished light. GL has them (render/splat/gl_targets.h), or the program
// (render/splat/memory_targets.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "render/image/image.h"
#include "render/model/covered.h"
#include "render/model/scene.h"
#include "render/splat/plane_pixels.h"

namespace render {

class GlTargets;

// Rows are from the bottom, row 0 first, but for Images.
class Targets {
 public:
    explicit Targets(glm::ivec2 size) : size_(size) {}
    virtual ~Targets() = default;
    Targets(const Targets&) = delete;
    Targets& operator=(const Targets&) = delete;

    glm::ivec2 size() const { return size_; }

    // For a program that sums planes itself. The depth of the opaque scene, a pixel each, or none
    // where nothing hides splats; `room` may be used for it, and must outlive it.
    virtual std::span<const float> opaqueDepth(std::vector<float>& room) const = 0;
    // Plane i of this kind, which is nothing outside this part of the picture. May leave other
    // memory than it was given.
    virtual void putPlane(std::size_t i, Channels channels, const PixelBox& part,
                          PlanePixels& pixels) = 0;

    // Row 0 at the top, as in Image. REQUIRES: plane i is Weight or Count.
    virtual std::vector<float> readScalarPlane(std::size_t i) const = 0;
    // Linear, premultiplied, four floats a pixel; `room` as for opaqueDepth(). REQUIRES of what is
    // in memory: its light was asked for as Linear.
    virtual std::span<const float> lightRows(std::vector<float>& room) const = 0;
    Image readLight() const;
    // The same, which is there no more then.
    virtual Image takeLight() { return readLight(); }
    // Where the light is in memory as Srgb8, four bytes a pixel; else none.
    virtual std::span<const std::uint8_t> srgb8() const { return {}; }
    // These targets as GL has them. What is in memory is written there.
    virtual GlTargets& onGl() = 0;

 private:
    glm::ivec2 size_;
};

// What light in memory is wanted as: to be read, or to be shown as it is.
enum class LightAs { Linear, Srgb8 };

template <typename T>
std::vector<T> turnedOver(std::vector<T> rows, glm::ivec2 size) {
    for (std::ptrdiff_t y = 0; y < size.y / 2; ++y)
        std::swap_ranges(rows.begin() + y * size.x, rows.begin() + (y + 1) * size.x,
                         rows.begin() + (size.y - 1 - y) * size.x);
    return rows;
}

inline Image Targets::readLight() const {
    std::vector<float> room;
    const std::span<const float> rows = lightRows(room);
    Image image(size_);
    const std::size_t row = 4 * static_cast<std::size_t>(size_.x);
    for (int y = 0; y < size_.y; ++y)
        std::memcpy(&image.at(0, size_.y - 1 - y), &rows[static_cast<std::size_t>(y) * row],
                    row * sizeof(float));
    return image;
}

}  // namespace render
