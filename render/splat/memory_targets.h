// The pixels of one eye in memory, for a program that draws them itself. Pure, but for onGl().
#pragma once

#include <memory>
#include <vector>

#include "render/splat/targets.h"

namespace render {

class MemoryTargets final : public Targets {
 public:
    explicit MemoryTargets(glm::ivec2 size);
    ~MemoryTargets() override;

    // A pixel each, or none where nothing hides splats.
    std::vector<float>& depth() { return depth_; }
    struct Plane {
        Channels channels;
        PixelBox part;
        PlanePixels pixels;
    };
    const Plane& plane(std::size_t i) const { return planes_[i]; }
    // One of them, with room for all pixels; the other is then empty.
    std::span<float> linearLight();
    std::span<std::uint8_t> srgb8Light();

    std::span<const float> opaqueDepth(std::vector<float>&) const override { return depth_; }
    void putPlane(std::size_t i, Channels channels, const PixelBox& part,
                  PlanePixels& pixels) override;
    std::vector<float> readScalarPlane(std::size_t i) const override;
    std::span<const float> lightRows(std::vector<float>&) const override;
    Image takeLight() override;
    std::span<const std::uint8_t> srgb8() const override { return srgb8_; }
    // REQUIRES: a current GL context, here and when this is destroyed.
    GlTargets& onGl() override;

 private:
    std::size_t pixels() const;

    std::vector<float> depth_;
    std::vector<glm::vec4> linear_;
    std::vector<std::uint8_t> srgb8_;
    std::vector<Plane> planes_;
    std::unique_ptr<GlTargets> onGl_;
};

}  // namespace render
